//! Spans and events of the feature `tracing`; without it they are nothing.

/// A span until the end of the block, as `tracing::debug_span`.
#[cfg(feature = "tracing")]
macro_rules! span {
    ($($what:tt)*) => { let _span = tracing::debug_span!($($what)*).entered(); };
}

/// Something out of the ordinary, as `tracing::warn`.
#[cfg(feature = "tracing")]
macro_rules! warning {
    ($($what:tt)*) => { tracing::warn!($($what)*) };
}

/// What a frame comes to, as `tracing::debug`.
#[cfg(feature = "tracing")]
macro_rules! detail {
    ($($what:tt)*) => { tracing::debug!($($what)*) };
}

#[cfg(not(feature = "tracing"))]
macro_rules! span {
    ($($what:tt)*) => {};
}

#[cfg(not(feature = "tracing"))]
macro_rules! warning {
    ($($what:tt)*) => {};
}

#[cfg(not(feature = "tracing"))]
macro_rules! detail {
    ($($what:tt)*) => {};
}

pub(crate) use {detail, span, warning};
