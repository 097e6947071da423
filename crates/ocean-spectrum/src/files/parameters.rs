//! The `key = value` lines of one partition.

use crate::files::{At, shortened, towards};
use crate::sea::partition::{Partition, Spectrum, Spreading, Tail, WIND_SEA_S};
use crate::{OceanError, SeaState};

const KEYS: &str =
    "spectrum, wind, fetch, hs, tp, gamma, direction, spreading, s, elongation, tail, depth-limited, depth";

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
    spreading: Option<Spread>,
    s: Option<f32>,
    elongation: Option<f32>,
    tail: Option<Short>,
    depth_limited: Option<bool>,
    any: bool,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Phillips,
    PiersonMoskowitz,
    Jonswap,
    Tma,
}

const KINDS: &[(&str, Kind)] = &[
    ("phillips", Kind::Phillips),
    ("pierson-moskowitz", Kind::PiersonMoskowitz),
    ("jonswap", Kind::Jonswap),
    ("tma", Kind::Tma),
];

#[derive(Clone, Copy, PartialEq)]
enum Spread {
    Cos2s,
    BothWays,
    Hasselmann,
    DonelanBanner,
}

const SPREADS: &[(&str, Spread)] = &[
    ("cos2s", Spread::Cos2s),
    ("both-ways", Spread::BothWays),
    ("hasselmann", Spread::Hasselmann),
    ("donelan-banner", Spread::DonelanBanner),
];

#[derive(Clone, Copy, PartialEq)]
enum Short {
    OfSpectrum,
    Donelan,
    Elfouhaily,
}

const TAILS: &[(&str, Short)] =
    &[("of-spectrum", Short::OfSpectrum), ("donelan", Short::Donelan), ("elfouhaily", Short::Elfouhaily)];

impl Keys {
    pub(crate) fn is_empty(&self) -> bool {
        !self.any
    }

    pub(crate) fn set(&mut self, at: At, key: &str, value: &str) -> Result<(), OceanError> {
        self.any = true;
        let (slot, range) = match key {
            "spectrum" => return once(at, key, &mut self.spectrum, word(at, key, value, KINDS)?),
            "spreading" => return once(at, key, &mut self.spreading, word(at, key, value, SPREADS)?),
            "tail" => return once(at, key, &mut self.tail, word(at, key, value, TAILS)?),
            "depth-limited" => {
                let value = word(at, key, value, &[("yes", true), ("no", false)])?;
                return once(at, key, &mut self.depth_limited, value);
            }
            "wind" => (&mut self.wind, 0.5..=80.0),
            "fetch" => (&mut self.fetch, 100.0..=1e8),
            "hs" => (&mut self.hs, 0.001..=40.0),
            "tp" => (&mut self.tp, 0.5..=40.0),
            "gamma" => (&mut self.gamma, 1.0..=20.0),
            "direction" => (&mut self.direction, -360.0..=360.0),
            "s" => (&mut self.s, 0.0..=1000.0),
            "elongation" => (&mut self.elongation, 0.0..=1.0),
            _ => return Err(at.error(format!("key `{}`", shortened(key)), KEYS)),
        };
        once(at, key, slot, at.number(key, value, range)?)
    }

    /// The partition, or what is missing or too much; `at` is its last line.
    pub(crate) fn finish(self, at: At) -> Result<Partition, OceanError> {
        let kind = self.spectrum.unwrap_or(Kind::Jonswap);
        // By height and period the wind is for what needs one beside the spectrum.
        let needed = self.spreading == Some(Spread::Hasselmann) || self.tail == Some(Short::Elfouhaily);
        let wind = if needed && self.hs.is_some() && kind != Kind::Phillips { None } else { self.wind };
        let spectrum = match (kind, wind, self.fetch, self.hs, self.tp) {
            (Kind::Phillips, Some(wind_speed), None, hs, None) => match hs {
                Some(significant_height) => Spectrum::Phillips { wind_speed, significant_height },
                None => SeaState::phillips(wind_speed, 0.0).partitions.swap_remove(0).spectrum,
            },
            (Kind::PiersonMoskowitz, Some(wind_speed), None, None, None) => Spectrum::PiersonMoskowitz { wind_speed },
            (Kind::Jonswap | Kind::Tma, Some(wind_speed), Some(fetch), None, None) if self.gamma.is_none() => {
                Spectrum::JonswapFetch { wind_speed, fetch }
            }
            (Kind::Jonswap | Kind::Tma, None, None, Some(significant_height), Some(peak_period)) => {
                Spectrum::Jonswap { significant_height, peak_period, gamma: self.gamma.unwrap_or(3.3) }
            }
            (Kind::Phillips, ..) => return Err(self.mismatch(at, "phillips takes wind, and hs if given")),
            (Kind::PiersonMoskowitz, ..) => return Err(self.mismatch(at, "pierson-moskowitz takes wind")),
            (Kind::Jonswap | Kind::Tma, ..) => {
                let allowed = "jonswap and tma take wind and fetch, or hs and tp, and gamma if given";
                return Err(self.mismatch(at, allowed));
            }
        };
        if self.gamma.is_some() && !matches!(kind, Kind::Jonswap | Kind::Tma) {
            return Err(self.mismatch(at, "gamma goes with jonswap and tma"));
        }
        if self.s.is_some() && !matches!(self.spreading, None | Some(Spread::Cos2s)) {
            return Err(at.error("`s` and another spreading", "`s` goes with cos2s"));
        }
        let wind_for = |what: &str| {
            let allowed = "wind, from 0.5 to 80";
            self.wind.ok_or_else(|| at.error(format!("{what} without wind"), allowed))
        };
        let spreading = match (self.spreading, self.s) {
            (None, None) if kind == Kind::Phillips => Spreading::BothWays,
            (None | Some(Spread::Cos2s), s) => Spreading::Cos2s { s: s.unwrap_or(WIND_SEA_S) },
            (Some(Spread::BothWays), _) => Spreading::BothWays,
            (Some(Spread::Hasselmann), _) => Spreading::Hasselmann { wind_speed: wind_for("hasselmann")? },
            (Some(Spread::DonelanBanner), _) => Spreading::DonelanBanner,
        };
        let tail = match self.tail {
            None | Some(Short::OfSpectrum) => Tail::OfSpectrum,
            Some(Short::Donelan) => Tail::Donelan,
            Some(Short::Elfouhaily) => Tail::Elfouhaily { wind_speed: wind_for("elfouhaily")? },
        };
        Ok(Partition {
            elongation: self.elongation.unwrap_or(0.0),
            depth_limited: self.depth_limited.unwrap_or(kind == Kind::Tma),
            tail,
            ..Partition::new(spectrum, towards(self.direction.unwrap_or(270.0)), spreading)
        })
    }

    fn mismatch(&self, at: At, allowed: &str) -> OceanError {
        let given =
            [("wind", self.wind), ("fetch", self.fetch), ("hs", self.hs), ("tp", self.tp), ("gamma", self.gamma)];
        let names: Vec<_> = given.iter().filter(|(_, value)| value.is_some()).map(|(name, _)| *name).collect();
        let found = if names.is_empty() { "nothing".into() } else { names.join(", ") };
        at.error(format!("a partition with {found}"), allowed)
    }
}

/// One of some words.
fn word<T: Copy>(at: At, key: &str, value: &str, words: &[(&str, T)]) -> Result<T, OceanError> {
    words.iter().find(|(name, _)| *name == value).map(|(_, meaning)| *meaning).ok_or_else(|| {
        let names: Vec<_> = words.iter().map(|(name, _)| *name).collect();
        at.error(format!("{key} `{}`", shortened(value)), names.join(", "))
    })
}

fn once<T>(at: At, key: &str, slot: &mut Option<T>, value: T) -> Result<(), OceanError> {
    match slot.replace(value) {
        None => Ok(()),
        Some(_) => Err(at.error(format!("a second `{key}`"), "one in a partition")),
    }
}
