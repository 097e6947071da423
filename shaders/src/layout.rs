//! The memory layout of parameter structs, as Rust has it, to be compared with what naga computes.

/// A field of a parameter struct.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Field {
    /// Name, the same in WGSL.
    pub name: &'static str,
    /// Offset in bytes.
    pub offset: usize,
}

/// Layout of a `repr(C)` struct shared with WGSL.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ParamLayout {
    /// Name, the same in WGSL.
    pub name: &'static str,
    /// Size in bytes.
    pub size: usize,
    /// Fields in order. Padding that WGSL inserts by itself is left out.
    pub fields: &'static [Field],
}

/// Builds a [`ParamLayout`] from a `repr(C)` struct and its field names.
#[macro_export]
macro_rules! param_layout {
    ($name:ident { $($field:ident),* $(,)? }) => {
        $crate::ParamLayout {
            name: stringify!($name),
            size: ::core::mem::size_of::<$name>(),
            fields: &[$($crate::Field {
                name: stringify!($field),
                offset: ::core::mem::offset_of!($name, $field),
            }),*],
        }
    };
}
