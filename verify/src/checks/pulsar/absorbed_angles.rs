//! Whether `phi_o` and `delta` can be absorbed in the initial values of `alpha` and `gamma`, as stated below Eq. (47).

use nalgebra::UnitVector3;

use crate::paper_examples::problem_from;
use crate::prelude::*;

checks! {
    /// delta is absorbed in the initial value of gamma, and with s^XX = s^YY also phi_o in that of alpha
    Property "beam-azimuth-absorbed" [45, 46, 47]: || {
        let equal = PrincipalCoefficients::new([0.015, 0.015, -0.04]);
        let beam = change_of_signal(&COEFFICIENTS, 0.0, 0.4)?;
        let both = change_of_signal(&equal, 0.7, 0.4)?;
        Ok(Measured::new(
            largest([beam, both]),
            format!("delta alone {beam:.1e}, both with s^XX = s^YY {both:.1e}"),
        ))
    };
    AtMost(1e-13) "largest change of m.n over 40 t_c of tp-I, delta = 0.4, phi_o = 0.7";
    because "rounding of the motion over 60 rad, and of angles that are put in differently";
    /// if s^XX and s^YY differ, phi_o is not absorbed in the initial value of alpha: another azimuth is another signal
    Regime "observer-azimuth-not-absorbed" [46, 47]:
        || Ok(Measured::new(change_of_signal(&COEFFICIENTS, 0.7, 0.0)?, ""));
    AtLeast(1e-3) "largest change of m.n over 40 t_c of tp-I, phi_o = 0.7";
    because "the potential depends on alpha with the amplitude s^XX - s^YY = 0.01";
}

/// Largest difference between `m.n` of tp-I with `phi_o` and `delta`, and that of the star rotated by these angles at the start.
fn change_of_signal(s: &PrincipalCoefficients<f64>, phi_o: f64, delta: f64) -> Result<f64, Error> {
    let problem = problem_from(s, &paper_examples()[0].initial_values()?)?;
    let given = *problem.initial();
    let signal = |phi_o: f64, delta: f64, start: &BodyState<f64>| {
        let motion = problem.starting_from(*start)?.taylor((0.0, 40.0), 1e-15)?;
        let (beam, n) = (Beam::new(0.5, delta, 0.6), Observer::at(0.8, phi_o).direction);
        (0..=400).map(|i| Ok(beam.margin(&motion.state(0.1 * f64::from(i))?, &n))).collect::<Result<Vec<_>, Error>>()
    };
    // The star turned by -phi_o about Z, and by delta about its own axis.
    let (about_z, about_axis) =
        (Rotation3::from_axis_angle(&Vector3::z_axis(), -phi_o), UnitVector3::new_normalize(given.axis));
    let x = Rotation3::from_axis_angle(&about_axis, delta) * given.equatorial_axis;
    let turned = BodyState { equatorial_axis: x, ..given }.rotated(about_z.matrix());
    let with_angles = signal(phi_o, delta, &given)?;
    let absorbed = signal(0.0, 0.0, &turned)?;
    Ok(largest(with_angles.iter().zip(&absorbed).map(|(a, b)| (a - b).abs())))
}
