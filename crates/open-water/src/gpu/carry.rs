//! How heights that are some ticks old are carried on to now: value, rate and curvature.
//!
//! The parabola through the newest height, that of the tick before and an older one. From a waiting time on that is long
//! against the waves of a boat, less and less of it is believed, and the newest height stays.

/// Seconds for which the parabola is believed, and after which it is not at all.
const BELIEVED: f32 = 0.3;
const FORGOTTEN: f32 = 0.6;

/// Factors of the newest height, of that of the tick before, and of the older one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Carry {
    /// Of the height now.
    pub(super) value: [f32; 3],
    /// Of its rate over the last tick, 1/s.
    pub(super) rate: [f32; 3],
    /// What the error grows with.
    pub(super) growth: f32,
}

impl Carry {
    /// Over `age` ticks of `dt` seconds. The older height is `older` ticks older than the newest, 2 or more; without one,
    /// the straight line through the others is taken.
    pub(super) fn new(age: u64, older: Option<u64>, dt: f32) -> Self {
        let x = age as f64;
        // The middle of the last tick, as of grids on the CPU.
        let y = x - 0.5;
        let (value, rate, growth) = match older.filter(|older| (2..=most(dt)).contains(older)) {
            Some(older) => {
                let m = older as f64;
                (
                    [(x + 1.0) * (x + m) / m, -x * (x + m) / (m - 1.0), x * (x + 1.0) / (m * (m - 1.0))],
                    [(2.0 * y + 1.0 + m) / m, -(2.0 * y + m) / (m - 1.0), (2.0 * y + 1.0) / (m * (m - 1.0))],
                    x * (x + 1.0) * (x + m) / 6.0,
                )
            }
            // The line's error over the parabola's, of waves of 1.2 s at 60 ticks.
            None => ([1.0 + x, -x, 0.0], [1.0, -1.0, 0.0], 5.0 * x * (x + 1.0)),
        };
        let belief = belief(age, dt);
        let stale = [1.0, 0.0, 0.0];
        Self {
            value: std::array::from_fn(|k| (belief * value[k] + (1.0 - belief) * stale[k]) as f32),
            rate: rate.map(|rate| (belief * rate / f64::from(dt)) as f32),
            growth: growth.min(f64::from(f32::MAX)) as f32,
        }
    }
}

/// How much is believed of what is carried on over `age` ticks of `dt` seconds, 0 to 1.
pub(super) fn belief(age: u64, dt: f32) -> f64 {
    f64::from(smoothstep((FORGOTTEN - age as f32 * dt) / (FORGOTTEN - BELIEVED)))
}

/// From 0 to 1 without a kink, as `t` does.
pub(super) fn smoothstep(t: f32) -> f32 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Ticks by which the older height may be older.
pub(super) fn most(dt: f32) -> u64 {
    ((BELIEVED / dt) as u64).max(2)
}

/// Sum of three heights by these factors.
pub(super) fn sum([a, b, c]: [f32; 3], [x, y, z]: [f32; 3]) -> f32 {
    a * x + b * y + c * z
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f32 = 1.0 / 60.0;

    /// Error over that of the newest height, of a wave of so many radians a second, rms over its phase.
    fn error(omega: f64, age: u64, older: Option<u64>) -> f64 {
        let carry = Carry::new(age, older, DT);
        let (mut ours, mut stale) = (0.0, 0.0);
        for phase in 0..64 {
            let z = |ticks: f64| (omega * ticks * f64::from(DT) + f64::from(phase) * 0.098_174_77).cos();
            let heights = [z(0.0), z(-1.0), z(-(older.unwrap_or(1) as f64))].map(|z| z as f32);
            ours += (f64::from(sum(heights, carry.value)) - z(age as f64)).powi(2);
            stale += (z(0.0) - z(age as f64)).powi(2);
        }
        (ours / stale).sqrt()
    }

    #[test]
    fn a_parabola_is_carried_on_as_it_is() {
        for (age, older) in [(0, 2), (3, 2), (6, 3), (10, 7)] {
            let carry = Carry::new(age, Some(older), DT);
            // A height thrown up at 3 m/s.
            let z = |ticks: f32| 0.2 + 3.0 * (ticks * DT) - 4.905 * (ticks * DT).powi(2);
            let heights = [z(0.0), z(-1.0), z(-(older as f32))];
            assert!((sum(heights, carry.value) - z(age as f32)).abs() < 1e-4, "{age} {older}");
            let rate = 3.0 - 9.81 * (age as f32 - 0.5) * DT;
            assert!((sum(heights, carry.rate) - rate).abs() < 1e-3, "{age} {older}");
        }
    }

    #[test]
    fn three_frames_at_thirty_err_by_less_than_a_quarter_of_the_stale_height() {
        // Waves from 40 m down to 1 m.
        for omega in [1.24, 2.5, 4.0, 6.0, 7.85] {
            let [parabola, line] = [Some(2), None].map(|older| error(omega, 6, older));
            assert!(parabola < 0.17 && parabola < line, "{omega}: {parabola}, {line}");
        }
        assert!(error(7.85, 6, None) > 0.25);
    }

    #[test]
    fn errors_grow_with_age_as_told() {
        for older in [Some(2), Some(5), None] {
            let [(young, found), (old, then)] = [3, 9].map(|age| {
                let stale = age as f64;
                (Carry::new(age, older, DT).growth, error(2.5, age, older) * stale)
            });
            let (told, found) = (f64::from(old / young), then / found);
            assert!((told / found - 1.0).abs() < 0.1, "{older:?}: {told} told, {found} found");
        }
    }

    #[test]
    fn what_is_much_too_old_stays_as_it_is() {
        for age in [36, 100, u64::MAX / 2, u64::MAX] {
            let carry = Carry::new(age, Some(2), DT);
            assert_eq!((carry.value, carry.rate), ([1.0, 0.0, 0.0], [0.0; 3]), "{age}");
            assert!(carry.growth.is_finite());
        }
        let gains = (0..200).map(|age| Carry::new(age, Some(2), DT).value.iter().map(|w| w.abs()).sum::<f32>());
        assert!(gains.fold(0.0f32, f32::max) < 1500.0);
        assert_eq!(Carry::new(4, Some(900), DT), Carry::new(4, None, DT));
    }
}
