//! The WGSL passes of Open Water, and everything both sides of a pass must agree on.
//!
//! One module per area (`ocean`, `grid`, `surface`, `view`); each owns its parameter structs, its constants and
//! its list of passes. [`ALL`] lists every pass, so that one test validates every shader and checks every struct's
//! offsets. *When* a pass runs is not decided here.

pub mod cubic;
pub mod grid;
pub mod layout;
pub mod ocean;
#[cfg(feature = "gpu")]
pub mod pipeline;
pub mod surface;
pub mod turns;
pub mod view;

pub use layout::{Field, ParamLayout};

/// One shader module: its WGSL text and what Rust knows about it.
#[derive(Debug, Clone, Copy)]
pub struct Pass {
    /// Name of the pass, of its WGSL file and of its test.
    pub name: &'static str,
    /// Generates the constants that Rust and WGSL share (may be empty).
    pub constants: fn() -> String,
    /// WGSL texts in order: shared parts first, the pass itself last.
    pub parts: &'static [&'static str],
    /// Entry points that the module must have.
    pub entry_points: &'static [&'static str],
    /// Structs shared between Rust and WGSL.
    pub params: &'static [ParamLayout],
}

impl Pass {
    /// The complete WGSL source.
    pub fn source(&self) -> String {
        let mut text = (self.constants)();
        for part in self.parts {
            text.push('\n');
            text.push_str(part);
        }
        text
    }
}

/// For passes without shared constants.
pub fn no_constants() -> String {
    String::new()
}

/// The lists of passes, one per area.
pub const ALL: &[&[Pass]] = &[ocean::PASSES, grid::PASSES, surface::PASSES, view::PASSES];

/// Every pass.
pub fn all() -> impl Iterator<Item = &'static Pass> {
    ALL.iter().flat_map(|passes| passes.iter())
}
