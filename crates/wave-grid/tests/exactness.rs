//! The same bits on every machine and any number of threads. What vector units do is tested beside the inner loops.

mod scenario;

use rayon::prelude::*;
use wave_grid::{GridDesc, Scheme, WaveGrid};

/// Hashes of [`scenario::grids`] after [`TICKS`] ticks, wherever this runs.
const HASHES: [u64; 8] = [
    0xa712701afd1bd07e,
    0xeb2b9bd090de981b,
    0xfe21036f420a73fe,
    0x1808b61ff8fee1f9,
    0x19959d7c107cab0e,
    0xb2207462cbd7cc65,
    0x8ec1348e88569e3c,
    0x739c0e8912b3eae4,
];
const TICKS: u32 = 240;

#[test]
fn bits_are_the_same_on_every_machine() {
    let hashes: Vec<u64> = scenario::grids()
        .into_par_iter()
        .map(|mut grid| {
            scenario::run(&mut grid, 0..TICKS);
            assert!(grid.is_finite() && !grid.is_asleep());
            grid.hash()
        })
        .collect();
    assert_eq!(hashes, HASHES, "{hashes:#x?}");
}

#[test]
fn bits_do_not_depend_on_the_number_of_threads() {
    for scheme in [Scheme::NinePoint, Scheme::Dispersive] {
        let hashes = [1, 2, 3].map(|threads| hash_with(threads, scheme));
        assert_eq!(hashes, [hashes[0]; 3], "{scheme:?}");
    }
}

fn hash_with(threads: usize, scheme: Scheme) -> u64 {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        // Enough tiles for several threads.
        let desc = GridDesc { cells: [416, 400], wave_speed: 25.0, scheme, ..Default::default() };
        let mut grid = WaveGrid::new(desc).unwrap();
        grid.set_medium(Some(std::sync::Arc::new(scenario::Harbour)));
        grid.set_tile_skipping(false);
        scenario::run(&mut grid, 0..60);
        assert!(grid.active_tiles() > 600);
        grid.hash()
    })
}
