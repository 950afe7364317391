//! Reference states of tp-II with `s` scaled by `k` from 1e-1 to 1e-6, at tenths of 30/k t_c, by the Taylor series over double-double
//! numbers:
//!
//! ```sh
//! cargo run --release -p twofold-tools --bin mean_reference > verify/data/mean_reference.csv
//! ```
//!
//! Three hours on one core, nearly all for 1e-6, which may be cut off: tenths are written as they come. Stretches as in `long_reference.rs`.

use std::io::Write as _;

use nalgebra::Matrix3;
use twofold::dynamics::BodyState;
use twofold::numerics::scalar::Scalar;
use twofold::propagation::{Motion, propagate};
use twofold_verify::double_double::DoubleDouble;
use twofold_verify::reference::reference_motion;

const STRETCH: f64 = 25_000.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = reference_motion("tp-2");
    let lift = DoubleDouble::from_f64;
    let spheroid = scene.spheroid.map(lift);
    let initial = scene.initial();
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "# tp-II with s scaled by k, by the Taylor series over double-double numbers (tools/src/bin/mean_reference.rs);"
    )?;
    writeln!(out, "# components rounded to doubles; t in t_c.")?;
    writeln!(out, "k,t,n_x,n_y,n_z,l_x,l_y,l_z,e_x,e_y,e_z")?;
    for exponent in 1..=6 {
        let k = 10f64.powi(-exponent);
        // As the check scales it: in doubles.
        let s: Matrix3<DoubleDouble> = scene.violation().map(|x| lift(x * k));
        let mut state = BodyState {
            axis: initial.axis.map(lift),
            momentum: initial.momentum.map(lift),
            equatorial_axis: initial.equatorial_axis.map(lift),
        };
        let mut time = 0.0;
        for tenth in 1..=10 {
            let end = (30.0 / k * f64::from(tenth) / 10.0).floor();
            while time < end {
                let step = STRETCH.min(end - time);
                state = propagate(&spheroid, &s, &state, (0.0, STRETCH), 1e-16)?.state(lift(step))?;
                time += step;
            }
            let numbers = state.axis.iter().chain(&state.momentum).chain(&state.equatorial_axis);
            let cells: Vec<_> = numbers.map(|x| format!("{:?}", x.high())).collect();
            writeln!(out, "{k:e},{time},{}", cells.join(","))?;
            out.flush()?;
        }
    }
    Ok(())
}
