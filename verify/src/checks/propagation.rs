//! The numerical motion: comparison with the 34-digit reference motions, its invariants, its dense output and its
//! derivatives.

use crate::double_double::DoubleDouble;
use crate::independent_taylor::state_after;
use crate::prelude::*;
use crate::reference::ReferenceMotion;

checks! {
    /// the numerical motion of ten scenes reproduces n, L, e_x of a 34-digit integration at every listed time
    Oracle "propagation-reference" [25]: against_reference::<BodyState<f64>>;
    AtMost(1e-12) "largest error of a component";
    because "rounding of the initial values (1e-16) and of up to 1,200 steps, grown with a phase of 600 rad";
    /// the error estimate of the numerical motion is not below its true error, from tolerance 1e-3 to 1e-14
    Oracle "propagation-error-estimate" [25]: estimate_against_truth::<BodyState<f64>>;
    AtMost(1.0) "largest true error / estimate";
    because "an estimate below the true error is wrong";
    /// E, Omega^z and K of the four examples of the paper do not drift over 400 t_c
    Property "propagation-integrals" [24]: integrals_of_examples;
    AtMost(1e-14) "largest drift / sum of the magnitudes of the integral's terms";
    because "rounding of 1,200 steps adds up as their square root, 35 times 1.1e-16";
    /// E, Omega^z, K, |n|, |e_x| and n.e_x are conserved along random motions over 50 units of time
    Property "propagation-random-integrals" [24]: integrals_of_random_motions;
    AtMost(8.0) "largest drift / (sum of magnitudes, 2.2e-16, sqrt(steps + 1))";
    because "a random walk of the rounding of each step, a few ulp at most each";
    /// the Euler angles of the dense output, differentiated twice in time by duals, satisfy Eq. (25)
    Autodiff "propagation-dense-output" [22, 25]: dense_output_solves_equations;
    AtMost(256.0) "largest (|a'' - a''(25)| sin b + |b'' - b''(25)|) sin^2 b / (size of the terms, 2.2e-16)";
    because "rounding of n is divided by sin^2 b; differentiating a series of order 22 twice multiplies its rounding by up to (22/3)^2";
    /// derivatives of the motion by a parameter, carried by duals through every step, agree with differences
    Autodiff "propagation-derivatives" [25]: derivatives_by_duals;
    AtMost(1e-6) "largest |dual - difference| / largest derivative";
    because "a central difference of step 1e-5 has 1e-10 of truncation, grown with t^3, and 1e-8 of rounding";
    /// a random motion propagated over 30 units of time and back returns to its start
    Property "propagation-time-reversal" [25]: time_reversal;
    AtMost(1.0) "largest error / sum of the two error estimates";
    because "the equations are reversible; what remains is the error that both ways estimate, and the other rate at which the way back turns e_x \
     about n";
    /// the motion in any units is the dimensionless one with time in t_c
    Property "propagation-units" [35]: scaling_in_time_unit;
    AtMost(1.0) "largest difference / sum of the two error estimates";
    because "the same motion, computed twice";
    /// a motion seen from a rotated inertial frame, the axis permutation (36) included, is the rotated motion
    Property "propagation-frame-covariance" [7, 36]: frame_covariance;
    AtMost(1.0) "largest difference / sum of the two error estimates";
    because "the same motion, computed twice";
}

/// Largest difference of two states; `L` is in units of its size if that is above one.
fn difference<X: RotationState<f64>>(a: &X, b: &X) -> f64 {
    largest_difference(a, b, b.axis_state().momentum.norm().max(1.0))
}

/// The numerical motion of `n`, `L` and, depending on the type of state, `e_x` of a reference motion, up to its last listed time.
fn motion_of<X: RotationState<f64>>(
    reference: &ReferenceMotion,
    tolerance: f64,
) -> Result<TaylorMotion<f64, X>, twofold::Error> {
    let problem = reference.problem();
    let start = X::from_vectors(problem.initial().vectors());
    let end = reference.states.last().map_or(0.0, |(t, _)| *t);
    Problem::new(reference.spheroid, *problem.coefficients(), start)?.taylor((0.0, end), tolerance)
}

pub(super) fn against_reference<X: RotationState<f64>>() -> Result<Measured, String> {
    worst_of(reference_motions(), |reference| {
        let motion = motion_of::<X>(reference, 1e-14)?;
        worst_of(&reference.states, |(t, state)| {
            Ok(largest_difference(&motion.state(*t)?, &X::from_vectors(state.vectors()), 1.0))
        })
    })
}

/// Compared with a series in 31 digits that starts from the same doubles: the rounding of a start from decimal numbers is no error of the motion, and
/// at 200 `t_c` can be twenty times as large.
pub(super) fn estimate_against_truth<X: RotationState<f64>>() -> Result<Measured, String> {
    worst_of(reference_motions(), |reference| {
        let problem = reference.problem();
        let truth: Vec<(f64, X)> = reference
            .states
            .iter()
            .map(|(t, _)| {
                let state = state_after::<DoubleDouble>(&problem, DoubleDouble::from_f64(*t), 1e-25);
                (*t, X::from_vectors(state.vectors().map(|v| v.map(DoubleDouble::high))))
            })
            .collect();
        worst_of((3..=14).map(|exponent| 10f64.powi(-exponent)), |&tolerance| {
            let motion = motion_of::<X>(reference, tolerance)?;
            worst_of(&truth, |(t, state)| Ok(difference(&motion.state(*t)?, state) / motion.error_estimate(*t)))
        })
    })
}

/// `[E, Omega^z, K]` and the sums of the magnitudes of their terms.
fn integrals_and_scales(problem: &Problem<f64>, state: &BodyState<f64>) -> ([f64; 3], [f64; 3]) {
    let (spheroid, s) = (problem.spheroid(), problem.coefficients());
    let integrals = first_integrals(spheroid, s, state);
    let (n, l) = (state.axis.abs(), state.momentum.abs());
    let (s_size, adjugate_size) = (s.abs(), symmetric_adjugate(s).abs());
    let c = spheroid.constant_c.abs();
    let energy = l.dot(&l) / (2.0 * spheroid.inertia_xx)
        + l.dot(&n).powi(2) / (2.0 * spheroid.inertia_zz)
        + c * n.dot(&(s_size * n));
    let clebsch = l.dot(&(s_size * l)) + 2.0 * c * spheroid.inertia_xx * n.dot(&(adjugate_size * n));
    ([integrals.energy, integrals.spin, integrals.clebsch], [energy, l.dot(&n) / spheroid.inertia_zz, clebsch])
}

fn integrals_of_examples() -> Result<Measured, String> {
    worst_of(["tp-1", "tp-2", "sp-1", "sp-2"], |name| {
        let problem = reference_motion(name).problem();
        let motion = problem.taylor((0.0, 400.0), 1e-14)?;
        let (start, scale) = integrals_and_scales(&problem, problem.initial());
        worst_of((0..=800).map(|i| f64::from(i) / 2.0), |&t| {
            let (now, _) = integrals_and_scales(&problem, &motion.state(t)?);
            Ok(largest([0, 1, 2].map(|k| (now[k] - start[k]).abs() / scale[k])))
        })
    })
}

fn integrals_of_random_motions() -> Result<Measured, String> {
    worst_over(1, 200, &scenes(), |scene| {
        let problem = scene.problem();
        let motion = problem.taylor((0.0, 50.0), 1e-14)?;
        let end = motion.state(50.0)?;
        let ((before, scale), (after, _)) =
            (integrals_and_scales(&problem, problem.initial()), integrals_and_scales(&problem, &end));
        let drift = largest((0..3).map(|k| (after[k] - before[k]).abs() / scale[k]));
        let frame = [end.axis.norm() - 1.0, end.equatorial_axis.norm() - 1.0, end.axis.dot(&end.equatorial_axis)];
        Ok(largest([drift, largest(frame.map(f64::abs))]) / (f64::EPSILON * (motion.step_count as f64 + 1.0).sqrt()))
    })
}

fn dense_output_solves_equations() -> Result<Measured, String> {
    worst_over(2, 100, &scenes(), |scene| {
        // The truncation must be far below rounding: two derivatives multiply it by (order / step)^2.
        let motion = scene.problem().map(Dual2_64::from_re).taylor((0.0, 10.0), 1e-16)?;
        worst_of(1..20, |&i| {
            let state = motion.state(Dual2_64::new(0.5 * f64::from(i), 1.0, 0.0))?;
            let EulerAngles { alpha: a, beta: b, gamma } = state.angles()?;
            let sin = b.re.sin();
            if sin.abs() < 1e-3 {
                return Ok(None);
            }
            let q = AxisAngles { alpha: a.re, beta: b.re, alpha_rate: a.v1, beta_rate: b.v1 };
            let spin = q.alpha_rate * q.beta.cos() + gamma.v1;
            let (alpha, beta) = euler_angle_accelerations(&scene.spheroid, &scene.s, spin, &q);
            let size = 1.0 + q.alpha_rate.abs().powi(2) + q.beta_rate.abs() * q.alpha_rate.abs();
            let residual = ((a.v2 - alpha) * sin).abs() + (b.v2 - beta).abs();
            Ok(Some(residual * sin * sin / (size * f64::EPSILON)))
        })
    })
}

fn derivatives_by_duals() -> Result<Measured, String> {
    let scene = reference_motion("tp-2");
    let at = |s_yy: f64| -> Result<[Vector3<f64>; 3], twofold::Error> {
        let s = PrincipalCoefficients { yy: s_yy, ..scene.coefficients }.tensor();
        Ok(Problem::new(scene.spheroid, s, scene.initial())?.taylor((0.0, 50.0), 1e-15)?.state(50.0)?.vectors())
    };
    let lifted: Problem<Dual64> = scene.problem().map(Dual64::from_re);
    let mut s = *lifted.coefficients();
    s[(1, 1)].eps = 1.0;
    let problem = Problem::new(*lifted.spheroid(), s, *lifted.initial())?;
    let dual = problem.taylor((0.0, 50.0), 1e-15)?.state(Dual64::from_re(50.0))?;
    let dual = dual.vectors().map(|vector| vector.map(|x| x.eps));
    let step = 1e-5;
    let (above, below) = (at(scene.coefficients.yy + step)?, at(scene.coefficients.yy - step)?);
    let size = largest(dual.iter().map(largest_component));
    worst_of(0..3, |&i| Ok(largest_component(&(dual[i] - (above[i] - below[i]) / (2.0 * step))) / size))
}

/// The state at the end of a span, and its estimated error.
fn end_of(problem: &Problem<f64>, span: (f64, f64)) -> Result<(BodyState<f64>, f64), twofold::Error> {
    let motion = problem.taylor(span, 1e-13)?;
    Ok((motion.state(span.1)?, motion.error_estimate(span.1)))
}

fn time_reversal() -> Result<Measured, String> {
    worst_over(3, 200, &scenes(), |scene| {
        let problem = scene.problem();
        let (end, there) = end_of(&problem, (0.0, 30.0))?;
        let (back, back_again) = end_of(&problem.starting_from(end)?, (30.0, 0.0))?;
        // On the way back e_x turns about n at the rate of that start, which depends on the rounding of L.n there.
        let (spheroid, initial) = (problem.spheroid(), problem.initial());
        let spin = |state: &BodyState<f64>| state.momentum.dot(&state.axis) / spheroid.inertia_zz;
        let turned = 30.0 * (spheroid.oblateness() * (spin(&end) - spin(initial))).abs();
        Ok(difference(&back, initial) / (there + back_again + turned))
    })
}

fn scaling_in_time_unit() -> Result<Measured, String> {
    worst_over(4, 200, &scenes(), |scene| {
        let (inertia, c): (f64, f64) = (2.7e3, 0.019);
        let unit = (inertia / c).sqrt();
        let problem = scene.problem();
        let (plain, estimate) = end_of(&problem, (0.0, 20.0))?;
        let spheroid = RigidSpheroid {
            inertia_xx: inertia * scene.spheroid.inertia_xx,
            inertia_zz: inertia * scene.spheroid.inertia_zz,
            constant_c: c * scene.spheroid.constant_c,
        };
        let initial = BodyState { momentum: problem.initial().momentum * (inertia / unit), ..*problem.initial() };
        let scaled = Problem::new(spheroid, *problem.coefficients(), initial)?;
        let (scaled, its_estimate) = end_of(&scaled, (0.0, 20.0 * unit))?;
        let scaled = BodyState { momentum: scaled.momentum / (inertia / unit), ..scaled };
        Ok(difference(&scaled, &plain) / (estimate + its_estimate))
    })
}

fn frame_covariance() -> Result<Measured, String> {
    worst_over(5, 200, &scenes(), |scene| {
        let (plain, estimate) = end_of(&scene.problem(), (0.0, 20.0))?;
        largest_of([body_from_inertial(&scene.angles), permuted_from_inertial()].map(|q| {
            let (rotated, its_estimate) = end_of(&scene.problem().rotated(&q), (0.0, 20.0))?;
            Ok(difference(&rotated, &plain.rotated(&q)) / (estimate + its_estimate))
        }))
    })
}
