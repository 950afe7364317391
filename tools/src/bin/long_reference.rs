//! Reference states of tp-II at 1e2 to 1e7 t_c, by the Taylor series over double-double numbers:
//!
//! ```sh
//! cargo run --release -p twofold-tools --bin long_reference > tools/bench/data/long.csv
//! ```
//!
//! Half an hour on one core; less with `RUSTFLAGS="-C target-feature=+fma"`. The motion consists of stretches of 25,000 t_c, each
//! restarted from the end of the one before: over one stretch the tolerance 1e-16 needs a truncation below 2e-25 per t_c, which a
//! phase growing for 1e7 t_c turns into 1e-11 at most.

use std::io::Write as _;

use twofold::numerics::scalar::{Scalar, length};
use twofold_bench::scene::BenchScene;
use twofold_tools::LongMotion;
use twofold_verify::double_double::DoubleDouble;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = BenchScene::named("tp-II");
    let problem = scene.problem.reduced().map(DoubleDouble::from_f64);
    let mut start = *problem.initial();
    // A unit vector to 32 digits: with 16 digits the rounding of its length would change the phase by 2e-11 at the end.
    start.axis /= length(&start.axis);
    let mut motion = LongMotion { problem: problem.starting_from(start)?, time: 0.0 };
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "# tp-II of scenes.csv by the Taylor series over double-double numbers (tools/src/bin/long_reference.rs);"
    )?;
    writeln!(
        out,
        "# n a unit vector; each component as the sum of two doubles; t in t_c. Truncation below 1e-11 at the end."
    )?;
    let names = ["n_x", "n_y", "n_z", "l_x", "l_y", "l_z"].map(|name| format!("{name},{name}_low"));
    writeln!(out, "scene,t,{}", names.join(","))?;
    for decade in 2..=7 {
        motion.advance_to(10f64.powi(decade))?;
        let state = motion.problem.initial();
        let numbers = state.axis.iter().chain(&state.momentum);
        let cells: Vec<_> = numbers.map(|x| format!("{:?},{:?}", x.high(), x.low())).collect();
        writeln!(out, "tp-II,{},{}", motion.time, cells.join(","))?;
        out.flush()?;
    }
    Ok(())
}
