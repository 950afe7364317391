//! Plans: what is forecast against what is counted, motions in closed form against numerical ones, gradients.

use std::cell::Cell;

use nalgebra::{DMatrix, Matrix3, Vector3};
use proptest::prelude::*;
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::numerics::scalar::Real;
use twofold::parameters::{Parameter, Parameters};
use twofold::plan::{Candidate, Method, Output, Plan, Request, StateFunction, gradient};
use twofold::propagation::{Motion, SymmetricMotion, UniformMotion, propagate};
use twofold::solutions::perturbation::Precession;
use twofold::solutions::steady::steady_precession_rate;

use crate::check::{Bound, Check, Kind, Measured, Worst, largest, largest_component};
use crate::physical_domain::{RandomScene, scenes, worst_over};
use crate::reference::reference_gradients;

/// Checks of this subject.
pub fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "plan-counts",
            kind: Kind::Property,
            equations: &[25],
            statement: "right-hand sides that a plan foresees are those of the motion, at random over accuracies, spans and states carried",
            figure: "largest ratio of counted to foreseen right-hand sides, or the inverse",
            bound: Bound::AtMost(2.0),
            reason: "the plan knows the first step; later ones are longer or shorter as torque and rotation add up or not",
            measure: counts,
        },
        Check {
            id: "plan-cheapest",
            kind: Kind::Property,
            equations: &[25],
            statement: "at random a plan takes the cheapest of the methods that are foreseen to meet the accuracy, each of them at times, with derivatives or without",
            figure: "plans of 600 with a method that is admitted and costs less",
            bound: Bound::AtMost(0.0),
            reason: "what a plan is; whether what is foreseen comes true: plan-error-bounds, plan-error-goals",
            measure: cheapest,
        },
        Check {
            id: "free-motion-bound",
            kind: Kind::Property,
            equations: &[48],
            statement: "free rotation in place of the motion is off by at most its rigorous bound, over 1e-2 to 1e2 t_c",
            figure: "largest difference of n, L and e_x from the numerical motion / (bound + its error estimate)",
            bound: Bound::AtMost(1.0),
            reason: "the bound follows from the largest torque alone",
            measure: free_bound,
        },
        Check {
            id: "symmetric-motion",
            kind: Kind::Oracle,
            equations: &[25],
            statement: "for two equal eigenvalues of s^IJ in any frame the motion by elliptic functions is the numerical one within both estimates, also where the eigenvalues differ a little",
            figure: "largest difference of n, L and e_x / sum of the two error estimates",
            bound: Bound::AtMost(1.0),
            reason: "the same motion, twice computed; the estimate counts rounding by the derivatives of the solution",
            measure: symmetric_motion,
        },
        Check {
            id: "steady-motion",
            kind: Kind::Oracle,
            equations: &[26],
            statement: "steady precession about any axis is the numerical motion, and states beside it are refused",
            figure: "largest difference of n, L and e_x / sum of the two error estimates",
            bound: Bound::AtMost(1.0),
            reason: "the same motion, twice computed",
            measure: steady_motion,
        },
        Check {
            id: "gradient-both-ways",
            kind: Kind::Oracle,
            equations: &[25],
            statement: "derivatives of n, L and e_x by fifteen parameters by the tangent maps of a splitting scheme are those of duals through Taylor series: 60 random motions in any frame, forwards and backwards",
            figure: "largest difference / (largest derivative by the same parameter at the same time, at least 1e-3); of values, / (1 + |L|)",
            bound: Bound::AtMost(2e-10),
            reason: "the accuracy of 1e-11 asked of the maps (1e-15 of the series), times 20: the model of error behind the choice of steps is one formula for all motions, and the worst of 3,000 exceeds it 8 times",
            measure: gradients_both_ways,
        },
        Check {
            id: "gradient-reference",
            kind: Kind::Oracle,
            equations: &[25],
            statement: "derivatives of n, L and e_x by fifteen parameters are those of 45-digit motions, two scenes, by tangent maps and by duals",
            figure: "largest error / largest derivative by the same parameter at the same time",
            bound: Bound::AtMost(1e-10),
            reason: "the accuracy of 1e-15 asked of the motion, times the growth of derivatives over 20 t_c; 1e-10 is what is promised",
            measure: gradients,
        },
    ]
}

/// Largest component of the difference of two states of a scene in units `I^xx = C = 1`, `L` in units of that at the start and of
/// what the torque makes of it.
fn difference(a: &BodyState<f64>, b: &BodyState<f64>, s: &Matrix3<f64>, initial: &BodyState<f64>) -> f64 {
    let anisotropic = s - Matrix3::from_diagonal_element(s.trace() / 3.0);
    let size = initial.momentum.norm() + (2.0 * anisotropic.norm()).sqrt();
    largest([
        largest_component(&(a.axis - b.axis)),
        largest_component(&(a.equatorial_axis - b.equatorial_axis)),
        largest_component(&((a.momentum - b.momentum) / size)),
    ])
}

fn counts() -> Result<Measured, String> {
    let strategy = (scenes(), -14.0..-3.0f64, 0.5..2.5f64, any::<bool>());
    worst_over(41, 200, &strategy, |&(scene, accuracy, span, full)| {
        let (body, s, initial) = (scene.spheroid(), scene.coefficients().tensor(), scene.state());
        let output = if full { Output::EquatorialAxis } else { Output::GravitationalWave };
        let request = Request {
            method: Some(Method::Taylor),
            ..Request::new(&[output], (0.0, 10f64.powf(span)), 10, 10f64.powf(accuracy))
        };
        let plan = Plan::from_parts(&body, &s, &initial, &request)?;
        let foreseen = plan.prediction.ok_or("a plan without prediction")?.work.right_hand_sides;
        let counted = if full {
            plan.motion_from_parts(&body, &s, &initial)?.work()
        } else {
            plan.axis_motion(&body, &s, &initial)?.work()
        };
        let ratio = counted.right_hand_sides / foreseen;
        Ok(ratio.max(1.0 / ratio))
    })
}

/// Scenes without, with little and with much violation, with two equal eigenvalues or not.
fn scenes_for_plans() -> impl Strategy<Value = RandomScene> {
    (scenes(), 0..4_u8, -16.0..-6.0f64).prop_map(|(mut scene, kind, log)| {
        match kind {
            0 => scene.s = [0.0; 3],
            1 => scene.s[1] = scene.s[0],
            2 => scene.s = scene.s.map(|x| x * 10f64.powf(log)),
            _ => {}
        }
        scene
    })
}

fn cheapest() -> Result<Measured, String> {
    let seen: [Cell<usize>; Method::ALL.len()] = Default::default();
    let cheaper = Cell::new(0);
    let strategy = (scenes_for_plans(), -12.0..-2.0f64, 0.0..2.0f64, 1..20_usize, 0..3_usize);
    worst_over(42, 600, &strategy, |&(scene, accuracy, span, samples, derivatives)| {
        let (body, s, initial) = (scene.spheroid(), scene.coefficients().tensor(), scene.state());
        let request = Request {
            derivatives: [Parameter::Beta, Parameter::InertiaZz][..derivatives].to_vec(),
            ..Request::new(&[Output::EquatorialAxis], (0.0, 10f64.powf(span)), samples, 10f64.powf(accuracy))
        };
        let plan = Plan::from_parts(&body, &s, &initial, &request)?;
        let (method, prediction) = plan.method.zip(plan.prediction).ok_or("a plan without a method")?;
        let less = |candidate: &Candidate| {
            candidate.prediction.as_ref().is_ok_and(|other| plan.admits(other) && other.cost < prediction.cost)
        };
        if plan.considered.iter().any(less) {
            cheaper.set(cheaper.get() + 1);
        }
        let place = Method::ALL.iter().position(|m| *m == method).ok_or("a method that is none")?;
        seen[place].set(seen[place].get() + 1);
        Ok(0.0)
    })?;
    let seen = seen.map(|count| count.get());
    // A steady precession is no accident.
    let rare = |(method, seen): (&Method, usize)| *method != Method::Steady && seen < 20;
    if Method::ALL.iter().zip(seen).any(rare) {
        return Err(format!("methods {seen:?} in the order of the list: some were hardly chosen"));
    }
    Ok(Measured::new(cheaper.get() as f64, format!("chosen {seen:?}, in the order of the list")))
}

fn free_bound() -> Result<Measured, String> {
    let strategy = (scenes_for_plans(), -2.0..2.0f64);
    worst_over(43, 400, &strategy, |&(scene, log)| {
        let (body, s, initial) = (scene.spheroid(), scene.coefficients().tensor(), scene.state());
        let span = (0.0, 10f64.powf(log));
        let free = UniformMotion::free_from_parts(&body, &s, &initial, span);
        let exact = propagate(&body, &s, &initial, span, 1e-15)?;
        let figure = |t: f64| {
            let off = difference(&free.state(t)?, &exact.state(t)?, &s, &initial);
            Ok::<_, String>(off / (free.error_estimate(t) + exact.error_estimate(t)))
        };
        Ok(largest([figure(span.1)?, figure(0.3 * span.1)?]))
    })
}

/// A tensor given in a frame turned by three angles.
fn turned(s: &Matrix3<f64>, initial: &BodyState<f64>, [a, b, c]: [f64; 3]) -> (Matrix3<f64>, BodyState<f64>) {
    let rotation = nalgebra::Rotation3::from_euler_angles(a, b, c).into_inner();
    (rotation * s * rotation.transpose(), initial.rotated(&rotation))
}

fn symmetric_motion() -> Result<Measured, String> {
    let solved = Cell::new(0);
    let strategy = (scenes(), prop::array::uniform3(-3.0..3.0f64), 0..3_u8, -12.0..-5.0f64, 0.0..2.0f64);
    let measured = worst_over(44, 400, &strategy, |&(mut scene, frame, kind, log, span)| {
        scene.s[1] = scene.s[0];
        if kind == 0 {
            scene.s[1] *= 1.0 + 10f64.powf(log);
        }
        let (body, s, initial) = (scene.spheroid(), scene.coefficients().tensor(), scene.state());
        // Axes exchanged, too: the symmetry axis need not be that of the last eigenvalue.
        let (s, initial) = if kind == 1 { (s, initial) } else { turned(&s, &initial, frame) };
        let span = (0.0, 10f64.powf(span));
        let Ok(motion) = SymmetricMotion::from_parts(&body, &s, &initial, span) else { return Ok(0.0) };
        solved.set(solved.get() + 1);
        let exact = propagate(&body, &s, &initial, span, 1e-15)?;
        let figure = |t: f64| {
            let off = difference(&motion.state(t)?, &exact.state(t)?, &s, &initial);
            Ok::<_, String>(off / (motion.error_estimate(t) + exact.error_estimate(t)))
        };
        Ok(largest([figure(0.0)?, figure(span.1)?, figure(0.37 * span.1)?]))
    })?;
    if solved.get() < 380 {
        return Err(format!("only {} of 400 scenes were solved", solved.get()));
    }
    Ok(measured)
}

fn steady_motion() -> Result<Measured, String> {
    let solved = Cell::new(0);
    let strategy = (scenes(), prop::array::uniform3(-3.0..3.0f64), any::<bool>(), any::<bool>());
    let measured = worst_over(45, 300, &strategy, |&(mut scene, frame, twofold, is_turned)| {
        scene.s[1] = scene.s[0];
        let (body, coefficients, angles) = (scene.spheroid(), scene.coefficients(), scene.angles());
        let kind = if twofold { Precession::Twofold } else { Precession::Single };
        let spin = scene.rates[2];
        let Ok(rate) = steady_precession_rate(kind, &body, &coefficients, spin, angles.beta) else { return Ok(0.0) };
        scene.rates = [rate, 0.0, spin - rate * angles.beta.cos()];
        let (s, initial) = (coefficients.tensor(), scene.state());
        let (s, initial) = if is_turned { turned(&s, &initial, frame) } else { (s, initial) };
        let span = (0.0, 50.0);
        let Ok(motion) = UniformMotion::steady_from_parts(&body, &s, &initial, span) else { return Ok(0.0) };
        solved.set(solved.get() + 1);
        // What turns faster or slower by 1e-6 is not steady, wherever the torque is above rounding.
        let beside = BodyState { momentum: initial.momentum * (1.0 + 1e-6), ..initial };
        let pull = scene.s[2] - scene.s[0];
        let (sin, cos) = angles.beta.sin_cos();
        let speed = rate.abs() + initial.momentum.norm() + (2.0 * pull.abs()).sqrt();
        let noticed = 1e-6 * (2.0 * pull * sin * cos).abs() / (speed * speed) > 1e-13;
        if noticed && UniformMotion::steady_from_parts(&body, &s, &beside, span).is_ok() {
            return Err("a state beside steady precession was taken for one".into());
        }
        let exact = propagate(&body, &s, &initial, span, 1e-15)?;
        let off = difference(&motion.state(50.0)?, &exact.state(50.0)?, &s, &initial);
        Ok(off / (motion.error_estimate(50.0) + exact.error_estimate(50.0)))
    })?;
    if solved.get() < 150 {
        return Err(format!("only {} of 300 scenes are steady", solved.get()));
    }
    Ok(measured)
}

/// Every component of the state.
pub(super) struct Components;

impl Components {
    /// The state of a row of their values.
    pub(super) fn state(values: &DMatrix<f64>) -> BodyState<f64> {
        let vector = |first: usize| Vector3::from_fn(|i, _| values[(0, first + i)]);
        BodyState { axis: vector(0), momentum: vector(3), equatorial_axis: vector(6) }
    }
}

impl StateFunction for Components {
    fn len(&self) -> usize {
        9
    }

    fn values<S: Real>(&self, _: &RigidSpheroid<S>, _: &Matrix3<S>, state: &BodyState<S>, values: &mut [S]) {
        let BodyState { axis, momentum, equatorial_axis } = state;
        for (value, component) in values.iter_mut().zip(axis.iter().chain(momentum).chain(equatorial_axis)) {
            *value = *component;
        }
    }
}

fn gradients() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for scene in reference_gradients() {
        let request = Request {
            derivatives: Parameter::OF_MOTION.to_vec(),
            ..Request::new(&[Output::EquatorialAxis], (0.0, 20.0), 2, 1e-15)
        };
        let start = &scene.start;
        let times: Vec<f64> = scene.derivatives.iter().map(|(t, _)| *t).collect();
        for method in [None, Some(Method::Taylor)] {
            let request = Request { method, ..request.clone() };
            let plan = Plan::from_parts(&start.spheroid, &start.violation, &start.state(), &request)?;
            let found = gradient(&plan, start, &Components, &times)?;
            for ((t, expected), found) in scene.derivatives.iter().zip(&found.jacobians) {
                for (i, parameter) in Parameter::OF_MOTION.iter().enumerate() {
                    let size = largest(expected[i].iter().map(|x| x.abs())).max(f64::MIN_POSITIVE);
                    let errors = expected[i].iter().enumerate().map(|(row, x)| (found[(row, i)] - x).abs());
                    let name = parameter.symbol();
                    worst.see(largest(errors) / size, || format!("{} by {name} at t = {t}, {method:?}", scene.name));
                }
            }
        }
    }
    worst.finish()
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
        let (s, _) = turned(&scene.coefficients().tensor(), &scene.state(), *frame);
        let start = Parameters::new(scene.spheroid(), s, scene.angles(), scene.rates());
        let end = if *backwards { -20.0 } else { 20.0 };
        let both = [None, Some(Method::Taylor)].map(|method| {
            let request = Request {
                derivatives: Parameter::OF_MOTION.to_vec(),
                method,
                ..Request::new(&[Output::EquatorialAxis], (0.0, end), 3, if method.is_some() { 1e-15 } else { 1e-11 })
            };
            let plan = Plan::from_parts(&start.spheroid, &s, &start.state(), &request)?;
            gradient(&plan, &start, &Components, &[end, 0.3 * end, 0.0])
        });
        let [Ok(ours), Ok(theirs)] = both else { return Err(format!("{both:?}")) };
        if ours.jacobians == theirs.jacobians && has_vectors() {
            return Err("both ways are the same way".into());
        }
        let mut most = (&ours.values - &theirs.values).amax() / (1.0 + start.state().momentum.norm());
        for (ours, theirs) in ours.jacobians.iter().zip(&theirs.jacobians) {
            for (a, b) in ours.column_iter().zip(theirs.column_iter()) {
                let size = largest(b.iter().map(|x| x.abs())).max(1e-3);
                most = largest([most, largest((a - b).iter().map(|x| x.abs())) / size]);
            }
        }
        Ok(most)
    })
}
