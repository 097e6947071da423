//! The `key = value` lines of one partition.

use crate::file::{At, shortened, towards};
use crate::partition::{Partition, Spectrum, Spreading, WIND_SEA_S};
use crate::{OceanError, SeaState};

/// What the lines of a partition have said so far.
#[derive(Default)]
pub(crate) struct Keys {
    spectrum: Option<Kind>,
    wind: Option<f32>,
    fetch: Option<f32>,
    hs: Option<f32>,
    tp: Option<f32>,
    gamma: Option<f32>,
    direction: Option<f32>,
    s: Option<f32>,
    any: bool,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Phillips,
    PiersonMoskowitz,
    Jonswap,
}

impl Keys {
    pub(crate) fn is_empty(&self) -> bool {
        !self.any
    }

    pub(crate) fn set(&mut self, at: At, key: &str, value: &str) -> Result<(), OceanError> {
        self.any = true;
        if key == "spectrum" {
            let kind = match value {
                "phillips" => Kind::Phillips,
                "pierson-moskowitz" => Kind::PiersonMoskowitz,
                "jonswap" => Kind::Jonswap,
                _ => {
                    let found = format!("spectrum `{}`", shortened(value));
                    return Err(at.error(found, "phillips, pierson-moskowitz, jonswap"));
                }
            };
            return once(at, key, &mut self.spectrum, kind);
        }
        let (slot, range) = match key {
            "wind" => (&mut self.wind, 0.5..=80.0),
            "fetch" => (&mut self.fetch, 100.0..=1e8),
            "hs" => (&mut self.hs, 0.001..=40.0),
            "tp" => (&mut self.tp, 0.5..=40.0),
            "gamma" => (&mut self.gamma, 1.0..=20.0),
            "direction" => (&mut self.direction, -360.0..=360.0),
            "s" => (&mut self.s, 0.0..=1000.0),
            _ => {
                let found = format!("key `{}`", shortened(key));
                return Err(at.error(found, "spectrum, wind, fetch, hs, tp, gamma, direction, s, depth"));
            }
        };
        once(at, key, slot, at.number(key, value, range)?)
    }

    /// The partition, or what is missing or too much; `at` is its last line.
    pub(crate) fn finish(self, at: At) -> Result<Partition, OceanError> {
        let kind = self.spectrum.unwrap_or(Kind::Jonswap);
        let spectrum = match (kind, self.wind, self.fetch, self.hs, self.tp) {
            (Kind::Phillips, Some(wind_speed), None, hs, None) => match hs {
                Some(significant_height) => Spectrum::Phillips { wind_speed, significant_height },
                None => SeaState::phillips(wind_speed, 0.0).partitions.swap_remove(0).spectrum,
            },
            (Kind::PiersonMoskowitz, Some(wind_speed), None, None, None) => Spectrum::PiersonMoskowitz { wind_speed },
            (Kind::Jonswap, Some(wind_speed), Some(fetch), None, None) if self.gamma.is_none() => {
                Spectrum::JonswapFetch { wind_speed, fetch }
            }
            (Kind::Jonswap, None, None, Some(significant_height), Some(peak_period)) => {
                Spectrum::Jonswap { significant_height, peak_period, gamma: self.gamma.unwrap_or(3.3) }
            }
            (Kind::Phillips, ..) => return Err(self.mismatch(at, "phillips takes wind, and hs if given")),
            (Kind::PiersonMoskowitz, ..) => return Err(self.mismatch(at, "pierson-moskowitz takes wind")),
            (Kind::Jonswap, ..) => {
                return Err(self.mismatch(at, "jonswap takes wind and fetch, or hs and tp, and gamma if given"));
            }
        };
        if self.gamma.is_some() && kind != Kind::Jonswap {
            return Err(self.mismatch(at, "gamma goes with jonswap"));
        }
        let spreading = match (self.s, kind) {
            (Some(s), _) => Spreading::Cos2s { s },
            (None, Kind::Phillips) => Spreading::BothWays,
            (None, _) => Spreading::Cos2s { s: WIND_SEA_S },
        };
        Ok(Partition::new(spectrum, towards(self.direction.unwrap_or(270.0)), spreading))
    }

    fn mismatch(&self, at: At, allowed: &str) -> OceanError {
        let given =
            [("wind", self.wind), ("fetch", self.fetch), ("hs", self.hs), ("tp", self.tp), ("gamma", self.gamma)];
        let names: Vec<_> = given.iter().filter(|(_, value)| value.is_some()).map(|(name, _)| *name).collect();
        let found = if names.is_empty() { "nothing".into() } else { names.join(", ") };
        at.error(format!("a partition with {found}"), allowed)
    }
}

fn once<T>(at: At, key: &str, slot: &mut Option<T>, value: T) -> Result<(), OceanError> {
    match slot.replace(value) {
        None => Ok(()),
        Some(_) => Err(at.error(format!("a second `{key}`"), "one in a partition")),
    }
}
