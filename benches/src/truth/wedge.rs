//! The half-angle of a ship's wake from its heights.
//!
//! Kelvin's wake ends at caustics, where its transverse and divergent waves meet and their envelope is Airy's function. The
//! greatest envelope at a distance x behind the source is thus at `y = x tan(alpha) - C x^(1/3)` from its course, with
//! `C = 0.5195 (U^2/g)^(2/3)` in deep water: Ai(-s) is greatest at s = 1.0188, and near the caustic
//! `s = 1.961 (g x/U^2)^(2/3) (tan(alpha) - y/x)` (from the phase `sec(theta) x + sec(theta) tan(theta) y`, in g/U^2, to third order about
//! `sin(theta) = 1/sqrt 3`). The next term of that series, in `x^(-1/3)`, tells how unequal the two waves are that the source
//! makes, and is fitted with alpha. A straight line would be 1 to 3 degrees too low over some wavelengths.
//!
//! The envelope is the modulus of the heights' part at the caustic's wavenumber along the course, `sqrt(3/2) g/U^2`, within .36
//! wavelengths. Sources a good part of U^2/g wide raise the angle by some tenths of a degree, wider ones make no cusp.

use std::f64::consts::TAU;

/// Gravity, m/s^2.
const GRAVITY: f64 = 9.81;
/// Ai's greatest place over the slope of s: see the module.
const AIRY: f64 = 0.5195;
/// Standard deviation of the window that the envelope is taken in, wavelengths 2 pi U^2/g; it ends at so many of it.
const WINDOW: f64 = 0.36;
const REACH: f64 = 2.2;
/// Nearest distance that counts, wavelengths.
const NEAREST: f64 = 1.5;

/// Where heights can be read: metres.
#[derive(Debug, Clone, Copy)]
pub struct Room {
    /// Between samples.
    pub step: f64,
    /// Farthest behind the source.
    pub behind: f64,
    /// Farthest to either side of its course.
    pub aside: f64,
}

/// A measured wedge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wedge {
    /// Half-angle, degrees.
    pub degrees: f64,
    /// Root mean square of the places about the fit, metres.
    pub scatter: f64,
    /// Places that were found.
    pub places: usize,
}

/// Half-angle of a dispersive wake of a source that sails at `speed`, m/s. `height(behind, aside)` in metres. `None` when fewer
/// than 8 places are found.
pub fn kelvin(speed: f64, room: Room, height: impl Fn(f64, f64) -> f64) -> Option<Wedge> {
    let number = GRAVITY / (speed * speed);
    let wavelength = TAU / number;
    let (across, carrier) = (WINDOW * wavelength, 1.5f64.sqrt() * number);
    let reach = (REACH * across / room.step).ceil() as i64;
    let window: Vec<[f64; 3]> = (-reach..=reach)
        .map(|i| {
            let x = i as f64 * room.step;
            let weight = (-0.5 * (x / across).powi(2)).exp();
            [x, weight * (carrier * x).cos(), weight * (carrier * x).sin()]
        })
        .collect();
    let last = room.behind - reach as f64 * room.step;
    let distances = (0..).map(|i| NEAREST * wavelength + 2.0 * i as f64 * room.step).take_while(|d| *d <= last);
    let mut places = Vec::new();
    for behind in distances {
        let envelope = |aside: f64| {
            let mut sum = [0.0; 2];
            for [x, cos, sin] in &window {
                let both = height(behind + x, aside) + height(behind + x, -aside);
                sum = [sum[0] + cos * both, sum[1] + sin * both];
            }
            sum[0].hypot(sum[1])
        };
        if let Some(aside) = greatest(0.15 * behind, room.aside, room.step, envelope) {
            places.push([behind, aside]);
        }
    }
    let c = AIRY * number.powf(-2.0 / 3.0);
    // y + C x^(1/3) = x tan(alpha) + e x^(-1/3).
    let given: Vec<[f64; 3]> = places.iter().map(|[x, y]| [*x, 1.0 / x.cbrt(), y + c * x.cbrt()]).collect();
    let ([tangent, _], scatter) = fit(&given)?;
    Some(Wedge { degrees: tangent.atan().to_degrees(), scatter, places: places.len() })
}

/// Half-angle of a wake of waves of one speed: a straight line through the greatest heights by distance behind the source, of
/// which the nearer third is left out.
pub fn mach(room: Room, height: impl Fn(f64, f64) -> f64) -> Option<Wedge> {
    let count = (room.behind / room.step) as usize;
    let mut given = Vec::new();
    for i in count / 3..count {
        let behind = i as f64 * room.step;
        let both = |aside: f64| (height(behind, aside) + height(behind, -aside)).abs();
        if let Some(aside) = greatest(0.0, room.aside, room.step, both) {
            given.push([behind, 1.0, aside]);
        }
    }
    let ([tangent, _], scatter) = fit(&given)?;
    Some(Wedge { degrees: tangent.atan().to_degrees(), scatter, places: given.len() })
}

/// Where a value is greatest between two places, a parabola through three samples; not at an end.
fn greatest(from: f64, to: f64, step: f64, value: impl Fn(f64) -> f64) -> Option<f64> {
    let values: Vec<f64> = (0..).map(|i| from + i as f64 * step).take_while(|y| *y <= to).map(value).collect();
    let top = (0..values.len()).max_by(|a, b| values[*a].total_cmp(&values[*b]))?;
    if top == 0 || top + 1 >= values.len() {
        return None;
    }
    let [before, at, after] = [values[top - 1], values[top], values[top + 1]];
    let bend = before - 2.0 * at + after;
    let aside = if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
    Some(from + (top as f64 + aside) * step)
}

/// Least squares of `[a, b, y]` by y = p a + q b: p, q and the root mean square of what is left.
fn fit(given: &[[f64; 3]]) -> Option<([f64; 2], f64)> {
    if given.len() < 8 {
        return None;
    }
    let sum = |i: usize, j: usize| given.iter().map(|row| row[i] * row[j]).sum::<f64>();
    let det = sum(0, 0) * sum(1, 1) - sum(0, 1) * sum(0, 1);
    let p = (sum(0, 2) * sum(1, 1) - sum(1, 2) * sum(0, 1)) / det;
    let q = (sum(1, 2) * sum(0, 0) - sum(0, 2) * sum(0, 1)) / det;
    let left: f64 = given.iter().map(|[a, b, y]| (y - p * a - q * b).powi(2)).sum();
    Some(([p, q], (left / given.len() as f64).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Kelvin's integral over the steady waves of a Gaussian source, by parts of the angle.
    fn wake(speed: f64, size: f64, behind: f64, aside: f64) -> f64 {
        let number = GRAVITY / (speed * speed);
        const PARTS: i32 = 300;
        let angle = |i: i32| 1.25 * f64::from(i) / f64::from(PARTS);
        (-PARTS..=PARTS)
            .map(|i| {
                let (sec, tan) = (1.0 / angle(i).cos(), angle(i).tan());
                let k = number * sec * sec;
                let source = (-0.5 * (k * size).powi(2)).exp() * sec.powi(4);
                source * (number * (sec * behind + sec * tan * aside)).sin()
            })
            .sum::<f64>()
            / f64::from(PARTS)
    }

    #[test]
    fn kelvins_angle_is_found_in_kelvins_integral() {
        let room = Room { step: 1.0, behind: 130.0, aside: 60.0 };
        for size in [0.6, 1.0] {
            // Windows overlap, sides are the same.
            let known = std::cell::RefCell::new(std::collections::HashMap::new());
            let height = |behind: f64, aside: f64| {
                let place = [behind, aside.abs()].map(|x| (x * 1e3).round() as i64);
                *known.borrow_mut().entry(place).or_insert_with(|| wake(5.0, size, behind, aside))
            };
            let wedge = kelvin(5.0, room, height).unwrap();
            assert!((wedge.degrees - (1.0f64 / 3.0).asin().to_degrees()).abs() < 0.5, "size {size}: {wedge:?}");
        }
    }

    #[test]
    fn a_wedge_of_crests_has_its_angle() {
        let room = Room { step: 0.5, behind: 60.0, aside: 50.0 };
        let crest = |behind: f64, aside: f64| (-(aside.abs() - 0.6 * behind - 1.0).powi(2) / 4.0).exp();
        let wedge = mach(room, crest).unwrap();
        assert!((wedge.degrees - 0.6f64.atan().to_degrees()).abs() < 0.05, "{wedge:?}");
    }
}
