//! How a call notes itself: a macro, so that it costs nothing without feature `serde`.

/// Notes an `Input` if the water is recorded.
macro_rules! note {
    ($water:expr, $input:expr) => {
        #[cfg(feature = "serde")]
        if $water.recorder.is_some() {
            let input = {
                use crate::record::Input;
                $input
            };
            if let Some(recorder) = &mut $water.recorder {
                recorder.push(&input);
            }
        }
    };
}
