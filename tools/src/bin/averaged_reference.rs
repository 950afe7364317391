//! Reference states of tp-II with `s` scaled by `k` from 1e-1 to 1e-6, at tenths of 30/k t_c, by the Taylor series over double-double
//! numbers:
//!
//! ```sh
//! cargo run --release -p twofold-tools --bin averaged_reference > verify/data/mean_reference.csv
//! ```
//!
//! Three hours on one core, mostly for 1e-6; that part can be cut off, since each tenth is written when it is done. Stretches as in
//! `long_reference.rs`.

use std::io::Write as _;

use twofold::dynamics::{Problem, RotationState};
use twofold::numerics::scalar::Scalar;
use twofold_tools::LongMotion;
use twofold_verify::double_double::DoubleDouble;
use twofold_verify::reference::reference_motion;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = reference_motion("tp-2");
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "# tp-II with s scaled by k, by the Taylor series over double-double numbers (tools/src/bin/averaged_reference.rs);"
    )?;
    writeln!(out, "# components rounded to doubles; t in t_c.")?;
    writeln!(out, "k,t,n_x,n_y,n_z,l_x,l_y,l_z,e_x,e_y,e_z")?;
    for exponent in 1..=6 {
        let k = 10f64.powi(-exponent);
        // Scaled in doubles, as in the check.
        let problem = Problem::new(scene.spheroid, scene.violation() * k, scene.initial())?;
        let mut motion = LongMotion { problem: problem.map(DoubleDouble::from_f64), time: 0.0 };
        for tenth in 1..=10 {
            motion.advance_to((30.0 / k * f64::from(tenth) / 10.0).floor())?;
            let vectors = motion.problem.initial().vectors();
            let cells: Vec<_> = vectors.iter().flatten().map(|x| format!("{:?}", x.high())).collect();
            writeln!(out, "{k:e},{},{}", motion.time, cells.join(","))?;
            out.flush()?;
        }
    }
    Ok(())
}
