//! Prints the coefficients of the dispersive scheme: `crates/wave-grid/src/dispersive/fitted.rs`.

use open_water_benches::fit::{Fitted, Task, print};

fn main() {
    print!("{}", print(&Fitted::new(&Task::SHIPPED)));
}
