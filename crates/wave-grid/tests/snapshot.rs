//! Going back: a run that was rolled back is the straight run.

mod scenario;

use proptest::prelude::*;
use wave_grid::{GridDesc, GridSnapshot, WaveGrid};

fn drawn(grid: &WaveGrid) -> Vec<[u32; 2]> {
    let mut cells = vec![[0.0; 2]; grid.heights().len()];
    grid.draw(0.4, &mut cells);
    cells.into_iter().map(|cell| cell.map(|v| (v + 0.0).to_bits())).collect()
}

fn assert_same(a: &WaveGrid, b: &WaveGrid, when: u32) {
    assert_eq!(a.hash(), b.hash(), "tick {when}");
    assert_eq!(drawn(a), drawn(b), "tick {when}");
    assert_eq!((a.is_asleep(), a.active_tiles()), (b.is_asleep(), b.active_tiles()), "tick {when}");
    assert_eq!((a.window(), a.dropped_sources()), (b.window(), b.dropped_sources()), "tick {when}");
}

#[test]
fn going_back_eight_ticks_again_and_again_is_the_straight_run() {
    for mut straight in scenario::grids() {
        let mut again = straight.clone();
        for t in (0..160).step_by(8) {
            let start = again.snapshot();
            // A guess of what comes that was wrong.
            scenario::run(&mut again, t + 40..t + 48);
            again.restore(&start).unwrap();
            scenario::run(&mut again, t..t + 8);
            scenario::run(&mut straight, t..t + 8);
            assert_same(&straight, &again, t + 8);
        }
        assert!(!straight.is_asleep());
    }
}

#[test]
fn a_calm_grid_goes_back_to_waves_and_waves_to_calm() {
    for mut grid in scenario::grids().into_iter().take(3) {
        let calm = grid.snapshot();
        scenario::run(&mut grid, 0..30);
        // Between a source and its tick.
        scenario::disturb(&mut grid, 30, 120);
        let (waves, then) = (grid.snapshot(), grid.clone());
        grid.restore(&calm).unwrap();
        assert!(grid.is_asleep() && grid.heights().iter().all(|z| *z == 0.0));
        let mut other = WaveGrid::new(*grid.desc()).unwrap();
        for grid in [&mut grid, &mut other] {
            grid.restore(&waves).unwrap();
            assert_same(&then, grid, 30);
        }
    }
}

#[test]
fn a_snapshot_of_another_grid_is_refused() {
    let small = WaveGrid::new(GridDesc { cells: [64; 2], ..Default::default() }).unwrap();
    let mut grid = WaveGrid::new(GridDesc::default()).unwrap();
    let message = grid.restore(&small.snapshot()).unwrap_err().to_string();
    assert!(message.contains("cells = 4096") && message.contains("same description"), "{message}");
}

#[derive(Debug, Clone)]
enum Action {
    Run(u32),
    Take(usize),
    Back(usize),
}

fn action() -> impl Strategy<Value = Action> {
    prop_oneof![
        (1u32..12).prop_map(Action::Run),
        (0usize..3).prop_map(Action::Take),
        (0usize..3).prop_map(Action::Back),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn any_walk_through_snapshots_is_a_straight_run(actions in prop::collection::vec(action(), 1..24), which in 0usize..8) {
        let start = scenario::grids().swap_remove(which);
        let mut grid = start.clone();
        let mut slots: [(GridSnapshot, Vec<u32>); 3] = std::array::from_fn(|_| (grid.snapshot(), Vec::new()));
        // The ticks that made what stands now.
        let mut history = Vec::new();
        let mut next = 0;
        for action in actions {
            match action {
                Action::Run(ticks) => {
                    for _ in 0..ticks {
                        scenario::run(&mut grid, next..next + 1);
                        history.push(next);
                        next = (next + 1) % 120;
                    }
                }
                Action::Take(slot) => slots[slot] = (grid.snapshot(), history.clone()),
                Action::Back(slot) => {
                    grid.restore(&slots[slot].0).unwrap();
                    history.clone_from(&slots[slot].1);
                }
            }
        }
        let mut straight = start;
        for t in history {
            scenario::run(&mut straight, t..t + 1);
        }
        prop_assert_eq!(grid.hash(), straight.hash());
        prop_assert_eq!(drawn(&grid), drawn(&straight));
    }
}
