//! Plans: predicted compared with counted work, motions in closed form compared with numerical ones, gradients.

use proptest::prelude::*;
use twofold::plan::{Gradient, Output, Prediction, Request, gradient};
use twofold::propagation::{SymmetricMotion, UniformMotion};

use crate::prelude::*;
use crate::reference::reference_gradients;

checks! {
    /// the numbers of right-hand sides that a plan predicts are those of the motion, at random over tolerances, spans and states carried
    Property "plan-counts" [25]: counts;
    AtMost(2.0) "largest ratio of counted to predicted right-hand sides, or the inverse";
    because "the plan knows the first step; later ones are longer or shorter as torque and rotation add up or not";
    /// at random no method requested by name is predicted to meet the tolerance at less cost than the method that a plan chooses, with
    /// derivatives or without; every method but steady precession is chosen at least 20 times
    Property "plan-cheapest" [25]: cheapest;
    AtMost(0.0) "methods by name, of six for each of 600 plans, that are admitted and cost less";
    because "a plan is the cheapest choice; whether the predictions are true is tested by plan-error-bounds and plan-error-goals";
    /// free rotation in place of the motion has an error of at most its rigorous bound, over 1e-2 to 1e2 t_c
    Property "free-motion-bound" [48]: free_bound;
    AtMost(1.0) "largest difference of n, L and e_x from the numerical motion / (bound + its error estimate)";
    because "the bound follows from the largest torque alone";
    /// for two equal eigenvalues of s^IJ in any frame the motion by elliptic functions agrees with the numerical one within both estimates, also
    /// if the eigenvalues differ a little
    Oracle "symmetric-motion" [25]: symmetric_motion;
    AtMost(1.0) "largest difference of n, L and e_x / sum of the two error estimates";
    because "the same motion, computed twice; the estimate counts rounding by the derivatives of the solution";
    /// steady precession about any axis agrees with the numerical motion, and nearby states are refused
    Oracle "steady-motion" [26]: steady_motion;
    AtMost(1.0) "largest difference of n, L and e_x / sum of the two error estimates";
    because "the same motion, computed twice";
    /// derivatives of n, L and e_x with respect to fifteen parameters by the tangent maps of a splitting scheme agree with duals through Taylor
    /// series: 60 random motions in any frame, forwards and backwards
    Oracle "gradient-both-ways" [25]: gradients_both_ways;
    AtMost(2e-10) "largest difference / (largest derivative by the same parameter at the same time, at least 1e-3); of values, / (1 + |L|)";
    because "the maps go by a tolerance of 1e-11 (the series by 1e-15), times 20: the model of the error behind the choice of steps is one formula \
     for all motions, and the worst of 3,000 motions exceeds it 8 times";
    /// derivatives of n, L and e_x by fifteen parameters are those of 45-digit motions, two scenes, by tangent maps, by duals and on the torus
    Oracle "gradient-reference" [25]: gradients;
    AtMost(2e-12) "largest error / largest derivative by the same parameter at the same time";
    because "splitting takes at most 14,800 stages, each rounded by 1.1e-16: 1.6e-12 if all add up. Errors grow with the phase, but so do the derivatives \
     that they are divided by; truncation is 1e-15";
}

/// Largest difference from the numerical motion at a time over the sum of both error estimates. The unit of `L` is its initial size plus what the torque
/// can add.
fn over_estimates(
    motion: &impl Motion<f64, State = BodyState<f64>>,
    exact: &TaylorMotion<f64>,
    problem: &Problem<f64>,
    t: f64,
) -> Result<f64, Error> {
    let (body, s) = (problem.spheroid(), problem.coefficients());
    let anisotropic = s - Matrix3::from_diagonal_element(s.trace() / 3.0);
    let pull = (2.0 * body.inertia_xx * body.constant_c.abs() * anisotropic.norm()).sqrt();
    let size = problem.initial().momentum.norm() + pull;
    let off = largest_difference(&motion.state(t)?, &exact.state(t)?, size);
    Ok(off / (motion.error_estimate(t) + exact.error_estimate(t)))
}

fn counts() -> Result<Measured, String> {
    let strategy = (scenes(), -14.0..-3.0f64, 0.5..2.5f64, any::<bool>());
    worst_over(41, 200, &strategy, |&(scene, tolerance, span, full)| {
        let problem = scene.problem();
        let output = if full { Output::EquatorialAxis } else { Output::GravitationalWave };
        let request = Request {
            method: Some(Method::Taylor),
            ..Request::new(&[output], (0.0, 10f64.powf(span)), 10, 10f64.powf(tolerance))
        };
        let plan = problem.plan(&request)?;
        let foreseen = plan.prediction.ok_or("a plan without prediction")?.work.right_hand_sides;
        let counted = if full { plan.motion(&problem)?.work() } else { plan.motion(&problem.reduced())?.work() };
        let ratio = counted.right_hand_sides / foreseen;
        Ok(ratio.max(1.0 / ratio))
    })
}

/// Scenes without, with weak and with strong violation, with two equal eigenvalues or not.
fn scenes_for_plans() -> impl Strategy<Value = RandomScene> {
    (scenes(), 0..4_u8, -16.0..-6.0f64).prop_map(|(mut scene, kind, log)| {
        match kind {
            0 => scene.s = PrincipalCoefficients::new([0.0; 3]),
            1 => scene.s.yy = scene.s.xx,
            2 => scene.s = scene.s.scaled(10f64.powf(log)),
            _ => {}
        }
        scene
    })
}

fn cheapest() -> Result<Measured, String> {
    let (mut seen, mut cheaper) = ([0; Method::ALL.len()], 0);
    let strategy = (scenes_for_plans(), -12.0..-2.0f64, 0.0..6.0f64, 0.0..5.5f64, 0..3_usize);
    worst_over(42, 600, &strategy, |&(scene, tolerance, span, samples, derivatives)| {
        let request = Request {
            derivatives: [Parameter::Beta, Parameter::InertiaZz][..derivatives].to_vec(),
            ..Request::new(
                &[Output::EquatorialAxis],
                (0.0, 10f64.powf(span)),
                10f64.powf(samples) as usize,
                10f64.powf(tolerance),
            )
        };
        let plan = scene.problem().plan(&request)?;
        let (method, prediction) = plan.method.zip(plan.prediction).ok_or("a plan without a method")?;
        // Every other method, requested by name, predicts its own work.
        for other in Method::ALL {
            let named = scene.problem().plan(&Request { method: Some(other), ..request.clone() });
            let admitted = |other: &Prediction| plan.admits(other) && other.cost < prediction.cost;
            cheaper += usize::from(named.is_ok_and(|named| named.prediction.as_ref().is_some_and(admitted)));
        }
        seen[Method::ALL.iter().position(|m| *m == method).ok_or("a method that is none")?] += 1;
        Ok(0.0)
    })?;
    // Random scenes do not precess steadily.
    let rare = |(method, seen): (&Method, &usize)| *method != Method::Steady && *seen < 20;
    if Method::ALL.iter().zip(&seen).any(rare) {
        return Err(format!("methods {seen:?} in the order of the list: some were hardly chosen"));
    }
    Ok(Measured::new(cheaper as f64, format!("chosen {seen:?}, in the order of the list")))
}

fn free_bound() -> Result<Measured, String> {
    let strategy = (scenes_for_plans(), -2.0..2.0f64);
    worst_over(43, 400, &strategy, |&(scene, log)| {
        let (problem, span) = (scene.problem(), (0.0, 10f64.powf(log)));
        let (free, exact) = (UniformMotion::free(&problem, span), problem.taylor(span, 1e-15)?);
        let figure = |share| over_estimates(&free, &exact, &problem, share * span.1);
        Ok(largest([figure(1.0)?, figure(0.3)?]))
    })
}

/// A problem seen from a frame turned by three angles.
pub(super) fn turned(problem: &Problem<f64>, [a, b, c]: [f64; 3]) -> Problem<f64> {
    problem.rotated(nalgebra::Rotation3::from_euler_angles(a, b, c).matrix())
}

fn symmetric_motion() -> Result<Measured, String> {
    let mut solved = 0;
    let strategy = (scenes(), prop::array::uniform3(-3.0..3.0f64), 0..3_u8, -12.0..-5.0f64, 0.0..2.0f64);
    let measured = worst_over(44, 400, &strategy, |&(mut scene, frame, kind, log, span)| {
        scene.s.yy = scene.s.xx;
        if kind == 0 {
            scene.s.yy *= 1.0 + 10f64.powf(log);
        }
        // The axes are exchanged, too: the symmetry axis need not be that of the last eigenvalue.
        let problem = if kind == 1 { scene.problem() } else { turned(&scene.problem(), frame) };
        let span = (0.0, 10f64.powf(span));
        let Ok(motion) = SymmetricMotion::new(&problem, span) else { return Ok(None) };
        solved += 1;
        let exact = problem.taylor(span, 1e-15)?;
        let figure = |share| over_estimates(&motion, &exact, &problem, share * span.1);
        Ok(Some(largest([figure(0.0)?, figure(1.0)?, figure(0.37)?])))
    })?;
    if solved < 380 {
        return Err(format!("only {solved} of 400 scenes were solved"));
    }
    Ok(measured)
}

fn steady_motion() -> Result<Measured, String> {
    let mut solved = 0;
    let strategy = (scenes(), prop::array::uniform3(-3.0..3.0f64), any::<bool>(), any::<bool>());
    let measured = worst_over(45, 300, &strategy, |&(mut scene, frame, twofold, is_turned)| {
        scene.s.yy = scene.s.xx;
        let (body, coefficients, angles) = (scene.spheroid, scene.s, scene.angles);
        let kind = if twofold { Precession::Twofold } else { Precession::Single };
        let spin = scene.rates.gamma;
        let Ok(rate) = steady_precession_rate(kind, &body, &coefficients, spin, angles.beta) else { return Ok(None) };
        scene.rates = EulerRates { alpha: rate, beta: 0.0, gamma: spin - rate * angles.beta.cos() };
        let problem = if is_turned { turned(&scene.problem(), frame) } else { scene.problem() };
        let span = (0.0, 50.0);
        let Ok(motion) = UniformMotion::steady(&problem, span) else { return Ok(None) };
        solved += 1;
        // A rotation faster by 1e-6 is not steady, if the torque is above rounding.
        let initial = problem.initial();
        let beside = problem.starting_from(BodyState { momentum: initial.momentum * (1.0 + 1e-6), ..*initial })?;
        let pull = body.constant_c * (scene.s.zz - scene.s.xx) / body.inertia_xx;
        let (sin, cos) = angles.beta.sin_cos();
        let speed = rate.abs() + initial.momentum.norm() / body.inertia_xx + (2.0 * pull.abs()).sqrt();
        let noticed = 1e-6 * (2.0 * pull * sin * cos).abs() / (speed * speed) > 1e-13;
        if noticed && UniformMotion::steady(&beside, span).is_ok() {
            return Err("a state beside steady precession was taken for one".into());
        }
        Ok(Some(over_estimates(&motion, &problem.taylor(span, 1e-15)?, &problem, span.1)?))
    })?;
    if solved < 150 {
        return Err(format!("only {solved} of 300 scenes are steady"));
    }
    Ok(measured)
}

/// The first of the states of a gradient.
pub(super) fn first_state(values: &DMatrix<f64>) -> BodyState<f64> {
    BodyState::from_vectors([0, 3, 6].map(|first| Vector3::from_fn(|i, _| values[(0, first + i)])))
}

/// The derivatives by every parameter at some times.
pub(super) fn derivatives(
    start: &Parameters<f64>,
    method: Option<Method>,
    tolerance: f64,
    times: &[f64],
) -> Result<Gradient, Error> {
    let end = times.iter().fold(0.0, |end: f64, t| if t.abs() > end.abs() { *t } else { end });
    let request = Request {
        derivatives: Parameter::OF_MOTION.to_vec(),
        method,
        ..Request::new(&[Output::EquatorialAxis], (0.0, end), times.len(), tolerance)
    };
    gradient(&start.problem()?.plan(&request)?, start, times)
}

fn gradients() -> Result<Measured, String> {
    worst_of(reference_gradients(), |scene| {
        let times: Vec<f64> = scene.derivatives.iter().map(|(t, _)| *t).collect();
        worst_of([None, Some(Method::Taylor), Some(Method::Torus)], |method| {
            let found = derivatives(&scene.start, *method, 1e-15, &times)?;
            worst_of(0..times.len(), |&k| {
                worst_of(Parameter::OF_MOTION.iter().enumerate(), |(i, _)| {
                    let (expected, found) = (&scene.derivatives[k].1[*i], found.jacobians[k].column(*i));
                    let size = largest(expected.iter().map(|x| x.abs())).max(f64::MIN_POSITIVE);
                    Ok(largest(expected.iter().zip(&found).map(|(x, found)| (found - x).abs())) / size)
                })
            })
        })
    })
}

/// Whether tangent maps are compiled for this processor.
pub(super) fn has_vectors() -> bool {
    #[cfg(target_arch = "x86_64")]
    return std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma");
    #[cfg(not(target_arch = "x86_64"))]
    return false;
}

fn gradients_both_ways() -> Result<Measured, String> {
    let strategy = (scenes(), prop::array::uniform3(-3.0..3.0f64), any::<bool>());
    worst_over(46, 60, &strategy, |(scene, frame, backwards)| {
        let violation = *turned(&scene.problem(), *frame).coefficients();
        let start = Parameters::new(scene.spheroid, violation, scene.angles, scene.rates);
        let end = if *backwards { -20.0 } else { 20.0 };
        let both = [(None, 1e-11), (Some(Method::Taylor), 1e-15)]
            .map(|(method, tolerance)| derivatives(&start, method, tolerance, &[end, 0.3 * end, 0.0]));
        let [Ok(ours), Ok(theirs)] = both else { return Err(format!("{both:?}")) };
        if ours.jacobians == theirs.jacobians && has_vectors() {
            return Err("both ways are the same way".into());
        }
        let values = largest_component(&(&ours.values - &theirs.values)) / (1.0 + start.state().momentum.norm());
        Ok(largest([values, largest_part(&ours, &theirs)]))
    })
}

/// Largest difference of derivatives over the largest one by the same parameter at the same time, at least 1e-3.
pub(super) fn largest_part(ours: &Gradient, theirs: &Gradient) -> f64 {
    let columns = |found: &Gradient| -> Vec<_> {
        found
            .jacobians
            .iter()
            .flat_map(|jacobian| jacobian.column_iter().map(|c| c.into_owned()).collect::<Vec<_>>())
            .collect()
    };
    largest(columns(ours).iter().zip(&columns(theirs)).map(|(a, b)| largest_component(&(a - b)) / b.amax().max(1e-3)))
}
