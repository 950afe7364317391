//! The exact motion for `s^XX = s^YY`: equations of motion, reference motions, numerical motion, derivatives and limits.

use crate::prelude::*;
use proptest::prelude::*;

checks! {
    /// the exact solution for s^XX = s^YY, differentiated twice in time by duals, satisfies Eq. (25) and conserves Omega^z
    Autodiff "symmetric-equations" [22, 25]: solves_equations;
    AtMost(64.0) "largest residual sin^2 b / (size of the terms, 2.2e-16)";
    because "a term of the second derivative is a product of three functions, each with the few units in the last place of its own check";
    /// the exact solution reproduces n and e_x of the 34-digit motions `axisymmetric-violation` and `free` up to 200 t_c
    Oracle "symmetric-reference" [25]: against_reference;
    AtMost(1e-13) "largest error of a component";
    because "phases of 300 rad with frequencies rounded to 2.2e-16";
    /// the exact solution and the numerical motion agree in n and e_x over 50 units of time, at random for s^XX = s^YY
    Oracle "symmetric-propagation" [25]: || worst_over(31, 300, &symmetric_scenes(), compare_with_propagation);
    AtMost(1.0) "largest difference / (error estimate of the numerical motion + 8 roundings of phase, initial angle and initial rate)";
    because "the same motion, computed twice; eight initial values and parameters are rounded";
    /// n and e_x of the exact solution are those of the numerical motion also from starts 1e-9 to 1e-2 rad from a pole
    Oracle "symmetric-poles" [25]: near_the_poles;
    AtMost(1.0) "largest difference / (error estimate of the numerical motion + 8 roundings of phase, initial angle and initial rate)";
    because "the same motion, computed twice; eight initial values and parameters are rounded";
    /// derivatives by s^ZZ and by the initial rates agree with those of the numerical motion, for s = 0 too
    Autodiff "symmetric-derivatives" [25]: derivatives;
    AtMost(64.0) "largest difference min(sin b)^2 / (largest derivative, 1 + phase, 2.2e-16)";
    because "a derivative of the integral R_J is right to a few units of its natural size, which is larger than the derivative by 1 / sin^2 of the \
     least distance from a pole";
    /// for s = 0 the exact solution is free precession about L, from any initial state
    Property "symmetric-free-limit" [25, 48]: free_limit;
    AtMost(8.0) "largest difference of n and e_x / (1 + phase, 2.2e-16)";
    because "a few roundings of the rates, times the time";
    /// started on either root of Eq. (26) the exact solution precesses steadily at that rate
    Property "symmetric-steady" [26]: steady;
    AtMost(4.0) "largest error of the angles at 50 units of time / (1 + phase, 1 + 1 / (stiffness sin^2 b), 2.2e-16)";
    because "roundings of the rates, times the time";
    /// after any number of periods beta returns and alpha, gamma have advanced by their mean rates
    Property "symmetric-period" [25]: periods;
    AtMost(4.0) "largest error sin^2 b / (1 + phase, 2.2e-16)";
    because "roundings of the period and of the rates, times the time";
    /// s^XX != s^YY, a start on the pole, the separatrix and unstable steady precession are refused with a reason
    Property "symmetric-refusals" [25]: refusals;
    AtMost(0.0) "cases not refused";
    because "each is outside the domain of the solution";
}

/// Random scenes with `s^XX = s^YY` and both signs of `s^ZZ - s^XX`, so that the quartic has four real roots or two. Half
/// of them have coefficients of up to 3, which trap the axis near the equator or a pole.
fn symmetric_scenes() -> impl Strategy<Value = RandomScene> {
    (scenes(), prop_oneof![Just(1.0), Just(10.0)]).prop_map(|(scene, strength)| {
        let s = scene.s.scaled(strength);
        RandomScene { s: PrincipalCoefficients { yy: s.xx, ..s }, ..scene }
    })
}

fn lifted<S: Real>(scene: &RandomScene) -> (RigidSpheroid<S>, PrincipalCoefficients<S>, EulerAngles<S>, EulerRates<S>) {
    let ([xx, yy, zz], q, v) = ([scene.s.xx, scene.s.yy, scene.s.zz].map(S::from_f64), scene.angles, scene.rates);
    let ([a, b, c], [u, v, w]) =
        ([q.alpha, q.beta, q.gamma].map(S::from_f64), [v.alpha, v.beta, v.gamma].map(S::from_f64));
    (
        scene.spheroid.map(S::from_f64),
        PrincipalCoefficients { xx, yy, zz },
        EulerAngles { alpha: a, beta: b, gamma: c },
        EulerRates { alpha: u, beta: v, gamma: w },
    )
}

fn solution<S: Real>(scene: &RandomScene) -> Result<SymmetricSolution<S>, String> {
    let (spheroid, s, angles, rates) = lifted(scene);
    SymmetricSolution::new(&spheroid, &s, &angles, &rates).map_err(String::from)
}

/// The state of a solution in inertial components.
fn state<S: Real>(spheroid: &RigidSpheroid<S>, solution: &SymmetricSolution<S>, t: S) -> BodyState<S> {
    BodyState::from_angles(spheroid, &solution.angles(t), &solution.rates(t))
}

/// Largest difference of n and e_x.
fn difference(a: &BodyState<f64>, b: &BodyState<f64>) -> f64 {
    largest_difference(a, b, f64::INFINITY)
}

/// The real parts and the derivatives as two states.
fn parts(state: &BodyState<Dual64>) -> [BodyState<f64>; 2] {
    let part = |of: fn(Dual64) -> f64| BodyState::from_vectors(state.vectors().map(|v| v.map(of)));
    [part(|x| x.re), part(|x| x.eps)]
}

fn solves_equations() -> Result<Measured, String> {
    worst_over(30, 500, &(symmetric_scenes(), -50.0..50.0f64), |(scene, t)| {
        let motion = solution::<Dual2_64>(scene)?;
        let angles = motion.angles(Dual2_64::new(*t, 1.0, 0.0));
        let rates = motion.rates(Dual2_64::from_re(*t));
        let q = AxisAngles {
            alpha: angles.alpha.re,
            beta: angles.beta.re,
            alpha_rate: angles.alpha.v1,
            beta_rate: angles.beta.v1,
        };
        let initial_spin = spin_in_angles(&scene.angles, &scene.rates);
        let spin = q.alpha_rate * q.beta.cos() + angles.gamma.v1;
        let (alpha, beta) = euler_angle_accelerations(&scene.spheroid, &scene.s, initial_spin, &q);
        let sin = q.beta.sin();
        let size = 1.0 + q.alpha_rate.powi(2) + (q.beta_rate * q.alpha_rate).abs() + scene.rates.gamma.powi(2);
        let residual = [
            (angles.alpha.v2 - alpha) * sin,
            angles.beta.v2 - beta,
            spin - initial_spin,
            (angles.alpha.v1 - rates.alpha.re) * sin,
            angles.beta.v1 - rates.beta.re,
            (angles.gamma.v1 - rates.gamma.re) * sin,
        ];
        Ok(largest(residual.map(f64::abs)) * sin * sin / (size * f64::EPSILON))
    })
}

fn against_reference() -> Result<Measured, String> {
    worst_of(["axisymmetric-violation", "free"], |name| {
        let scene = reference_motion(name);
        let motion = SymmetricSolution::new(&scene.spheroid, &scene.coefficients, &scene.angles, &scene.rates)?;
        worst_of(&scene.states, |(t, expected)| Ok(difference(&state(&scene.spheroid, &motion, *t), expected)))
    })
}

/// Largest difference over the error estimate of the numerical motion plus unavoidable rounding: that of the phase, and
/// that of the initial rate of `beta`, carried to `t` by the derivative of the motion.
fn compare_with_propagation(scene: &RandomScene) -> Result<f64, String> {
    // Derivatives by the initial inclination and its rate: near the unstable equator both grow exponentially.
    let solutions = [0, 1].map(|variable| {
        let (spheroid, s, mut angles, mut rates) = lifted::<Dual64>(scene);
        if variable == 0 {
            angles.beta.eps = 1.0
        } else {
            rates.beta.eps = 1.0
        }
        SymmetricSolution::new(&spheroid, &s, &angles, &rates).map_err(String::from)
    });
    let [by_angle, by_rate] = solutions;
    let (by_angle, by_rate) = (by_angle?, by_rate?);
    let spheroid = lifted::<Dual64>(scene).0;
    let numerical = scene.problem().taylor((0.0, 50.0), 1e-15)?;
    let none = BodyState::from_vectors([Vector3::zeros(); 3]);
    let mut most = 0.0_f64;
    for i in 0..=25 {
        let t = 2.0 * f64::from(i);
        let sensitive = [&by_angle, &by_rate].map(|solution| parts(&state(&spheroid, solution, Dual64::from_re(t))));
        let sensitivity: f64 = sensitive.iter().map(|[_, derivatives]| difference(derivatives, &none)).sum();
        let rounding = 8.0 * f64::EPSILON * (phase(scene, t) + sensitivity);
        let difference = difference(&sensitive[1][0], &numerical.state(t)?);
        most = largest([most, difference / (numerical.error_estimate(t) + rounding)]);
    }
    Ok(most)
}

fn near_the_poles() -> Result<Measured, String> {
    let start = (symmetric_scenes(), -9.0..-2.0f64, any::<bool>()).prop_map(|(mut scene, log, south)| {
        let distance = 10f64.powf(log);
        scene.angles.beta = if south { PI - distance } else { distance };
        scene
    });
    worst_over(32, 300, &start, compare_with_propagation)
}

fn derivatives() -> Result<Measured, String> {
    let strategy = (symmetric_scenes(), 0..4_usize, any::<bool>());
    worst_over(33, 100, &strategy, |&(scene, variable, no_violation)| {
        let scene = if no_violation { RandomScene { s: PrincipalCoefficients::new([0.0; 3]), ..scene } } else { scene };
        let (spheroid, mut s, angles, mut rates) = lifted::<Dual64>(&scene);
        match variable {
            0 => s.zz.eps = 1.0,
            1 => rates.alpha.eps = 1.0,
            2 => rates.beta.eps = 1.0,
            _ => rates.gamma.eps = 1.0,
        }
        let t = Dual64::from_re(10.0);
        let exact = SymmetricSolution::new(&spheroid, &s, &angles, &rates)?;
        let (smallest, most) = exact.inclinations();
        let sin = smallest.re.sin().min(most.re.sin());
        let exact = state(&spheroid, &exact, t);
        let problem = Problem::from_angles(spheroid, s.tensor(), &angles, &rates)?;
        let [[_, exact], [_, numerical]] = [exact, problem.taylor((0.0, 10.0), 1e-16)?.state(t)?].map(|at| parts(&at));
        let size = numerical.axis.amax().max(numerical.equatorial_axis.amax()).max(1.0);
        let error = largest_difference(&exact, &numerical, 1.0);
        Ok(error * sin * sin / (size * phase(&scene, 10.0) * f64::EPSILON))
    })
}

/// `1 +` the angle of rotation in `t` (rad).
fn phase(scene: &RandomScene, t: f64) -> f64 {
    let state = scene.state();
    1.0 + t
        * (state.momentum.norm() / scene.spheroid.inertia_xx
            + (scene.rates.alpha.abs() + scene.rates.beta.abs() + scene.rates.gamma.abs()))
}

fn free_limit() -> Result<Measured, String> {
    worst_over(34, 500, &(symmetric_scenes(), 0.0..100.0f64), |&(scene, t)| {
        let scene = RandomScene { s: PrincipalCoefficients::new([0.0; 3]), ..scene };
        let exact = state(&scene.spheroid, &solution(&scene)?, t);
        let free = free_rotation(&scene.spheroid, &scene.state(), t);
        Ok(difference(&exact, &free) / (phase(&scene, t) * f64::EPSILON))
    })
}

fn steady() -> Result<Measured, String> {
    let mut solved = 0;
    let measured = worst_over(35, 500, &(symmetric_scenes(), any::<bool>()), |&(mut scene, twofold)| {
        let kind = if twofold { Precession::Twofold } else { Precession::Single };
        let (spheroid, s, angles, _) = lifted::<f64>(&scene);
        let spin = scene.rates.gamma;
        let Ok(rate) = steady_precession_rate(kind, &spheroid, &s, spin, angles.beta) else {
            return Ok(None);
        };
        scene.rates = EulerRates { alpha: rate, beta: 0.0, gamma: spin - rate * angles.beta.cos() };
        let (sin, cos) = angles.beta.sin_cos();
        let k = 2.0 * spheroid.constant_c * (s.zz - s.xx) / spheroid.inertia_xx;
        let stiffness =
            (rate * sin).powi(2) + spheroid.free_precession_constant(spin).powi(2) + k * (sin * sin - 4.0 * cos * cos);
        if stiffness <= 0.0 {
            return Ok(Some(if solution::<f64>(&scene).is_err() { 0.0 } else { f64::INFINITY }));
        }
        solved += 1;
        let motion: SymmetricSolution<f64> = solution(&scene)?;
        let (t, now) = (50.0, motion.angles(50.0));
        let errors = [
            now.alpha - angles.alpha - rate * t,
            now.beta - angles.beta,
            now.gamma - angles.gamma - scene.rates.gamma * t,
            (motion.mean_rates().alpha - rate) * t,
        ];
        // The rounding of the rate tilts the axis by that amount over the stiffness.
        let condition = 1.0 + 1.0 / (stiffness * sin * sin);
        Ok(Some(largest(errors.map(f64::abs)) / (phase(&scene, t) * condition * f64::EPSILON)))
    })?;
    if solved < 300 {
        return Err(format!("only {solved} scenes have a stable steady precession"));
    }
    Ok(measured)
}

fn periods() -> Result<Measured, String> {
    worst_over(36, 500, &(symmetric_scenes(), -5.0..5.0f64, -20..20_i32), |&(scene, t, count)| {
        let motion: SymmetricSolution<f64> = solution(&scene)?;
        let elapsed = f64::from(count) * motion.period();
        let (before, after, mean) = (motion.angles(t), motion.angles(t + elapsed), motion.mean_rates());
        let errors = [
            after.alpha - before.alpha - mean.alpha * elapsed,
            after.beta - before.beta,
            after.gamma - before.gamma - mean.gamma * elapsed,
        ];
        let sin = before.beta.sin();
        Ok(largest(errors.map(f64::abs)) * sin * sin / (phase(&scene, elapsed.abs() + t.abs()) * f64::EPSILON))
    })
}

fn refusals() -> Result<Measured, String> {
    let spheroid = RigidSpheroid::in_units_of_tc(1.1);
    let at = |s: [f64; 3], beta: f64, rates: [f64; 3]| {
        let [alpha, beta_rate, gamma] = rates;
        let angles = EulerAngles { alpha: 0.0, beta, gamma: 0.0 };
        let rates = EulerRates { alpha, beta: beta_rate, gamma };
        SymmetricSolution::new(&spheroid, &PrincipalCoefficients::new(s), &angles, &rates)
    };
    // Without spin and L_Z the axis swings like a pendulum. At the initial rate cos beta0 it comes to rest on the equator.
    let cases = [
        ("asymmetric", at([0.1, 0.2, 0.3], 1.0, [1.0, 0.0, 0.0])),
        ("pole", at([0.0, 0.0, 0.1], 0.0, [1.0, 0.1, 0.0])),
        ("separatrix", at([0.0, 0.0, -0.5], 1.0, [0.0, 1.0_f64.cos(), 0.0])),
        ("unstable steady", at([0.0, 0.0, -0.5], PI / 2.0, [0.0, 0.0, 0.0])),
        ("not a number", at([0.0, 0.0, -0.5], 1.0, [f64::NAN, 0.0, 0.0])),
    ];
    let missed: Vec<&str> =
        cases.iter().filter(|(_, r)| !matches!(r, Err(Error::Domain { .. }))).map(|(name, _)| *name).collect();
    Ok(Measured::new(missed.len() as f64, format!("not refused: {missed:?}")))
}
