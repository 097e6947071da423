//! Time and bits: the same sea at any time, on any number of threads.

use ocean_spectrum::{CascadeDesc, Ocean, OceanDesc};

fn sea(loop_time: f64) -> Ocean {
    let cascades = vec![CascadeDesc::new(128, 485.0), CascadeDesc::new(128, 60.0)];
    Ocean::new(OceanDesc { cascades, loop_time, seed: 3, ..Default::default() }).unwrap()
}

/// FNV-1a over every bit of every array.
fn hash(ocean: &Ocean) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325u64;
    for c in 0..ocean.modes().len() {
        let f = ocean.fields(c);
        for value in [f.displacement, f.derivative, f.velocity].into_iter().flatten().flatten() {
            hash = (hash ^ u64::from(value.to_bits())).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
    hash
}

#[test]
fn phases_are_as_exact_at_ten_million_seconds() {
    for loop_time in [200.0, 600.3, 1024.0] {
        let ocean = sea(loop_time);
        let most = ocean.modes().iter().flat_map(|m| &m.n).copied().max().unwrap();
        for i in 0..2000 {
            let t = 1e7 + 0.37 * f64::from(i);
            // `%` is exact in f64, and so is its product with an n below 2^13 to 40 bits.
            let exact = (f64::from(most) * ((t % loop_time) / loop_time)).fract();
            let ours = f64::from(most.wrapping_mul(ocean.phase_at(t))) / 4_294_967_296.0;
            let off = (ours - exact).abs();
            assert!(off.min(1.0 - off) < 1e-6, "{off}");
        }
    }
}

#[test]
fn the_sea_repeats_after_the_loop_and_runs_backwards() {
    let mut ocean = sea(256.0);
    ocean.set_time(5.25);
    let now = hash(&ocean);
    for t in [5.25 + 256.0, 5.25 - 256.0, 5.25 + 256.0 * 39_062.0] {
        ocean.set_time(0.0);
        assert_ne!(hash(&ocean), now);
        ocean.set_time(t);
        assert_eq!(hash(&ocean), now);
    }
}

#[test]
fn bits_do_not_depend_on_the_number_of_threads() {
    let hashes = [1, 2, 5].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut ocean = sea(256.0);
            ocean.set_time(77.0);
            hash(&ocean)
        })
    });
    assert_eq!(hashes[0], hashes[1]);
    assert_eq!(hashes[0], hashes[2]);
}

#[test]
fn the_sea_is_the_same_bits_everywhere() {
    // Written down once: nothing in the path depends on the machine.
    let mut ocean = sea(256.0);
    ocean.set_time(77.0);
    assert_eq!(self::hash(&ocean), 0x72db_4a35_823c_cdaa, "{:#x}", self::hash(&ocean));
    let mut hash = 0xcbf2_9ce4_8422_2325u64;
    for modes in ocean.modes() {
        for value in modes.amp.iter().flatten().map(|a| a.to_bits()).chain(modes.n.iter().copied()) {
            hash = (hash ^ u64::from(value)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
    assert_eq!(hash, 0x933e_288f_763e_3499, "{hash:#x}");
}

#[test]
fn seeds_make_different_seas() {
    let make = |seed| Ocean::new(OceanDesc { seed, ..Default::default() }).unwrap().height(glam::Vec2::ZERO);
    assert!((make(1) - make(2)).abs() > 1e-3);
}
