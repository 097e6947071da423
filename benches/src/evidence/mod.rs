//! What every case of the evidence uses.

mod context;
mod heap;
pub mod limits;
mod machine;
mod plot;
mod readback;
mod report;
mod table;
mod timing;

pub use context::{Context, Gpu};
pub use heap::{allocations, heap_bytes};
pub use machine::{Adapter, Machine};
pub use plot::{Axis, Plot, draw, picture};
pub use report::{Report, Row, SCHEMA};
pub use table::table;
pub use timing::{Effort, Timing, fastest, measure, measure_together};

/// What a case may fail with: any error of the crates, or words.
pub type CaseError = Box<dyn std::error::Error + Send + Sync>;

/// One topic of the evidence: gives rows.
pub struct Case {
    /// The name in the rows and on the command line.
    pub name: &'static str,
    /// What is shown, in one line.
    pub about: &'static str,
    /// Pictures drawn from its rows.
    pub plots: &'static [Plot],
    /// Makes the rows.
    pub run: fn(&Context) -> Result<Vec<Row>, CaseError>,
}
