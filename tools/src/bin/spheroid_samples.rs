//! Prints A_0, A_1, A_3 and C of random spheroids, for comparison with multiprecision by `verify/oracles/mpmath/spheroid_ulps.py`:
//!
//! ```sh
//! cargo run --release -p twofold-tools --bin spheroid_samples | python3 verify/oracles/mpmath/spheroid_ulps.py
//! ```

use std::io::Write;

use twofold::star::potential_coefficients::potential_coefficients;
use twofold::star::spheroid_shape::SpheroidShape;
use twofold::star::uniform_spheroid::UniformSpheroid;
use twofold_verify::random::Random;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut random = Random::with_seed(9);
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    for i in 0..100_000 {
        // A quarter oblate with e from 1e-13 on a logarithmic scale, a quarter with e up to 0.999, half prolate.
        let (name, parameter) = match i % 4 {
            0 => ("e", 0.999 * 10f64.powf(random.within(-13.0, 0.0))),
            1 => ("e", random.within(0.0, 0.999)),
            _ => ("q", random.within(1.0, 10.0)),
        };
        let shape = if name == "e" {
            SpheroidShape::from_eccentricity(parameter)
        } else {
            SpheroidShape::from_axis_ratio(parameter)
        }?;
        let a = potential_coefficients(&shape);
        let c = UniformSpheroid::new(1.0, 1.0, shape)?.c();
        writeln!(out, "{name} {parameter:?} {:?} {:?} {:?} {c:?}", a.a0, a.a1, a.a3)?;
    }
    Ok(())
}
