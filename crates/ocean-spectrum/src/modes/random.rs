//! The crate's own random numbers: a hash, so that a mode's phase depends on nothing but its name.

/// Steele, Lea, Flood 2014 (`splitmix64`): a bijection of u64 in which every bit depends on every bit.
fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// Phase, in turns of 2^32, of the mode with integer wavevector `(i, j)` in a cascade, and a second number of 32 bits that
/// has nothing to do with it. The FFT size has no part in them.
pub(crate) fn mode(seed: u64, cascade: usize, i: i32, j: i32) -> (u32, u32) {
    let place = (u64::from(i as u32) << 32) | u64::from(j as u32);
    let bits = mix(mix(mix(seed) ^ cascade as u64) ^ place);
    ((bits >> 32) as u32, bits as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn phase(seed: u64, cascade: usize, i: i32, j: i32) -> u32 {
        mode(seed, cascade, i, j).0
    }

    #[test]
    fn phases_are_even_and_uncorrelated() {
        let mut sum = [0.0f64; 2];
        let mut neighbour = [0.0f64; 2];
        let n = 200;
        for i in -n..n {
            for j in -n..n {
                let turn = |p: u32| f64::from(p) / 4_294_967_296.0 * std::f64::consts::TAU;
                let a = turn(phase(7, 1, i, j));
                let b = a - turn(phase(7, 1, i + 1, j));
                sum = [sum[0] + a.cos(), sum[1] + a.sin()];
                neighbour = [neighbour[0] + b.cos(), neighbour[1] + b.sin()];
            }
        }
        // A random walk of 160,000 unit steps ends within 400 sqrt(1/2) per axis; four deviations.
        for x in sum.into_iter().chain(neighbour) {
            assert!(x.abs() < 4.0 * 400.0 * 0.71, "{sum:?} {neighbour:?}");
        }
    }

    #[test]
    fn the_definition_does_not_drift() {
        // splitmix64 of Vigna's reference code: the first output after a state of 0.
        assert_eq!(mix(0), 0xe220_a839_7b1d_cdaf);
        assert_ne!(phase(0, 0, 1, 0), phase(0, 0, 0, 1));
        assert_ne!(phase(0, 0, 1, 0), phase(0, 1, 1, 0));
        assert_ne!(phase(0, 0, 1, 0), phase(1, 0, 1, 0));
    }
}
