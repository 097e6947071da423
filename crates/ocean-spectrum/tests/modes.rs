//! Unit and Gaussian amplitudes.

use ocean_spectrum::{Amplitudes, CascadeDesc, Ocean, OceanDesc, SeaState};

fn make(size: u32, tile: f32, seed: u64, amplitudes: Amplitudes) -> Ocean {
    let cascades = vec![CascadeDesc::new(size, tile), CascadeDesc::new(size, tile / 7.0)];
    Ocean::new(OceanDesc { cascades, seed, amplitudes, ..Default::default() }).unwrap()
}

#[test]
fn gaussian_amplitudes_are_rayleigh_of_the_same_variance() {
    let (unit, gaussian) = (make(128, 400.0, 3, Amplitudes::Unit), make(128, 400.0, 3, Amplitudes::Gaussian));
    let (mut n, mut sum, mut square, mut small) = (0.0, 0.0, 0.0, 0.0);
    for (unit, gaussian) in unit.modes().iter().zip(gaussian.modes()) {
        assert_eq!(unit.n, gaussian.n);
        for (u, g) in unit.amp.iter().zip(&gaussian.amp) {
            let power = |a: &[f32; 4]| f64::from(a[0]).powi(2) + f64::from(a[1]).powi(2);
            if power(u) < 1e-30 {
                continue;
            }
            // The phase is that of unit modulus.
            let across = f64::from(u[0]) * f64::from(g[1]) - f64::from(u[1]) * f64::from(g[0]);
            assert!(across.abs() <= 1e-6 * (power(u) * power(g)).sqrt());
            let share = power(g) / power(u);
            n += 1.0;
            sum += share;
            square += share * share;
            small += f64::from(u8::from(share < 0.1));
        }
    }
    // Exponential: mean 1, mean square 2, a share of 1 - exp(-.1) below a tenth; 30,000 modes, four deviations.
    assert!(n > 20_000.0, "{n}");
    assert!((sum / n - 1.0f64).abs() < 4.0 / n.sqrt(), "{}", sum / n);
    assert!((square / n - 2.0).abs() < 4.0 * 20f64.sqrt() / n.sqrt(), "{}", square / n);
    assert!((small / n - (1.0 - (-0.1f64).exp())).abs() < 4.0 * 0.3 / n.sqrt(), "{}", small / n);
}

#[test]
fn the_mean_over_seeds_of_gaussian_seas_is_the_sea_described() {
    // 3 peak wavelengths of 60.6 m.
    let seeds = 48;
    let (mut mean, mut square) = (0.0, 0.0);
    for seed in 0..seeds {
        let ocean = make(32, 182.0, seed, Amplitudes::Gaussian);
        let ratio = ocean.modes().iter().map(|m| m.variance()).sum::<f64>()
            / make(32, 182.0, seed, Amplitudes::Unit).modes().iter().map(|m| m.variance()).sum::<f64>();
        mean += ratio / f64::from(seeds as u32);
        square += (ratio - 1.0) * (ratio - 1.0) / f64::from(seeds as u32);
    }
    // 13 % in the height is 26 % in the variance of a seed.
    let scatter = square.sqrt();
    assert!((0.12..0.45).contains(&scatter), "{scatter}");
    assert!((mean - 1.0).abs() < 3.5 * scatter / 48f64.sqrt(), "{mean} {scatter}");
}

#[test]
fn sizes_hold_the_same_gaussian_modes() {
    let (small, large) = (make(64, 485.0, 9, Amplitudes::Gaussian), make(256, 485.0, 9, Amplitudes::Gaussian));
    for (small, large) in small.modes().iter().zip(large.modes()) {
        for (cell, amp) in small.amp.iter().enumerate() {
            let (i, j) = (small.signed(cell as u32 % 64), small.signed(cell as u32 / 64));
            if i == -32 || j == -32 {
                continue;
            }
            let same = (j.rem_euclid(256) * 256 + i.rem_euclid(256)) as usize;
            assert_eq!((amp, small.n[cell]), (&large.amp[same], large.n[same]));
        }
    }
}

#[test]
fn the_same_description_gives_the_same_bits() {
    // Written down once: random numbers, spectrum and spreading do not depend on the machine.
    let mut hash = 0xcbf2_9ce4_8422_2325u64;
    let mut sea = SeaState::tma(12.0, 80e3, 0.4, 15.0).with_swell(1.0, 11.0, 2.0);
    sea.partitions[0].spreading = ocean_spectrum::Spreading::DonelanBanner;
    sea.partitions[0].elongation = 0.3;
    sea.partitions[0].tail = ocean_spectrum::Tail::Elfouhaily { wind_speed: 12.0 };
    sea.partitions[1].spreading = ocean_spectrum::Spreading::Hasselmann { wind_speed: 12.0 };
    sea.partitions[1].tail = ocean_spectrum::Tail::Donelan;
    let cascades = vec![CascadeDesc::new(64, 300.0), CascadeDesc::new(64, 40.0)];
    let amplitudes = Amplitudes::Gaussian;
    let ocean = Ocean::new(OceanDesc { sea, seed: 5, cascades, amplitudes, ..Default::default() }).unwrap();
    for modes in ocean.modes() {
        for value in modes.amp.iter().flatten().map(|a| a.to_bits()).chain(modes.n.iter().copied()) {
            hash = (hash ^ u64::from(value)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
    assert_eq!(hash, 0xcc85_e9ee_29ed_4311, "{hash:#x}");
}
