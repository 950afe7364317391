//! The plan: what is computed, by which method, and what is skipped.

use super::candidate::evaluations;
use super::{Candidate, Cost, Evaluations, Method, Output, PlannedMotion, Prediction, Request, State};
use crate::dynamics::equations_of_motion::angular_velocity;
use crate::dynamics::{AxisState, Problem, RotationState};
use crate::error::Error;
use crate::parameters::Parameter;
use crate::propagation::largest_torque;

/// Rounding above the tolerance is accepted unless that of another method is smaller by this factor.
const FAR_BELOW: f64 = 100.0;

/// A quantity that a plan does not compute.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Skipped {
    /// The skipped quantity.
    pub what: &'static str,
    /// The reason.
    pub why: &'static str,
}

/// The computation for a [`Request`].
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The outputs.
    pub outputs: Vec<Output>,
    /// The part of the state that the outputs need.
    pub state: State,
    /// The method; `None` if no output needs a motion.
    pub method: Option<Method>,
    /// Whether the method was requested by name.
    pub forced: bool,
    /// Times of the initial state and of the end of the motion.
    pub span: (f64, f64),
    /// Number of samples that are evaluated; zero if only events are requested.
    pub samples: usize,
    /// Parameters with respect to which derivatives are computed.
    pub derivatives: Vec<Parameter>,
    /// Allowed truncation error of the motion at the end of its span.
    pub tolerance: f64,
    /// The prediction for the method; `None` if there is no method.
    pub prediction: Option<Prediction>,
    /// Every method in the order of [`Method::ALL`], with its prediction or the reason why it cannot be used; [`Method::Torus`] only if it may be the
    /// chosen one.
    pub considered: Vec<Candidate>,
    /// The skipped quantities.
    pub skipped: Vec<Skipped>,
}

impl Plan {
    pub(super) fn new<X: RotationState<f64>>(problem: &Problem<f64, X>, request: &Request) -> Result<Self, Error> {
        let state = request.outputs.iter().map(|output| output.need().state).max().unwrap_or(State::Nothing);
        let evaluated =
            |wanted: fn(Evaluations) -> bool| request.outputs.iter().any(|output| wanted(output.need().evaluations));
        let at_samples = evaluated(|e| matches!(e, Evaluations::AtSamples | Evaluations::CountingTurns { .. }));
        let for_events = evaluated(|e| matches!(e, Evaluations::ForEvents { .. }));
        let span = request.span;
        let rotation = (span.1 - span.0).abs() * turning_rate(problem);
        let count = evaluations(request, rotation);
        let mut plan = Self {
            outputs: request.outputs.clone(),
            state,
            method: None,
            forced: request.method.is_some(),
            span,
            samples: if at_samples { request.samples } else { 0 },
            derivatives: request.derivatives.clone(),
            tolerance: request.tolerance,
            prediction: None,
            considered: Vec::new(),
            skipped: Vec::new(),
        };
        if state != State::Nothing {
            let problem = problem.with_equatorial_axis();
            let wanted = |method: &Method| request.method.is_none_or(|forced| forced == *method);
            let candidate = |method| Candidate::of(method, &problem, request, state, span, count);
            // The errors of a series on the torus are known only once it is computed. It is tried if it would be the cheapest, or if the others lose
            // the required accuracy to rounding.
            let others = Method::ALL.into_iter().filter(|method| *method != Method::Torus);
            plan.considered = others.filter(wanted).map(candidate).collect();
            let cost = Cost::with_derivatives(Method::Torus, state, request.derivatives.len()).total(0, 0.0, count);
            let is_better = |best: &Prediction| cost < best.cost || best.rounding > FAR_BELOW * request.tolerance;
            let is_tried = || plan.choose().is_ok_and(|(_, best)| is_better(&best));
            if request.method.map_or_else(is_tried, |forced| forced == Method::Torus) {
                plan.considered.push(candidate(Method::Torus));
                plan.considered.sort_by_key(|candidate| candidate.method);
            }
            let (method, prediction) = plan.choose()?;
            (plan.method, plan.prediction) = (Some(method), Some(prediction));
        }
        plan.skipped = plan.left_out(for_events);
        Ok(plan)
    }

    /// Whether the method may be chosen. Its truncation error must be below the tolerance, or below the error of every method that is: where these lose
    /// more to rounding, a method that just misses the tolerance is no worse. Its rounding, if above the tolerance, must be at most a hundred times
    /// the error of another method: after 1e12 turns phases in doubles no longer have the required accuracy.
    pub fn admits(&self, prediction: &Prediction) -> bool {
        let least_error = |allowed: f64| {
            let predictions = self.considered.iter().filter_map(|candidate| candidate.prediction.as_ref().ok());
            // The rounding of an elliptic solution that misses the tolerance is not known.
            let accurate = predictions.filter(|other| other.truncation <= allowed && !other.rounding.is_nan());
            accurate.map(|other| other.truncation.max(other.rounding)).reduce(f64::min)
        };
        let Some(reached) = least_error(self.tolerance) else { return false };
        let allowed = reached.max(self.tolerance);
        let least = least_error(allowed).unwrap_or(reached);
        prediction.truncation <= allowed && prediction.rounding <= (FAR_BELOW * least).max(self.tolerance)
    }

    /// The cheapest admissible method, or the method that was requested.
    fn choose(&self) -> Result<(Method, Prediction), Error> {
        let mut best: Option<(Method, Prediction)> = None;
        for Candidate { method, prediction } in &self.considered {
            match prediction {
                Ok(prediction)
                    if (self.forced || self.admits(prediction))
                        && best.is_none_or(|(_, best)| prediction.cost < best.cost) =>
                {
                    best = Some((*method, *prediction));
                }
                // A star with a bulge has no Taylor series.
                Err(Error::Unsupported { .. }) if !self.forced => {}
                Err(error) if self.forced || *method == Method::Taylor => return Err(error.clone()),
                _ => {}
            }
        }
        best.ok_or_else(|| self.why_none())
    }

    /// The reason why the averaged motion cannot be used. Without that motion only the Taylor series meets any tolerance.
    fn why_none(&self) -> Error {
        let averaged = self.considered.iter().find(|candidate| candidate.method == Method::Averaged);
        match &averaged.expect("considered where no method was asked for").prediction {
            Err(error) => error.clone(),
            Ok(prediction) => Error::Domain {
                quantity: "truncation error of the averaged motion, the only method for a star with a bulge, at the end",
                value: prediction.truncation,
                allowed: "at most the tolerance; use a weaker violation, a shorter span or a larger tolerance",
            },
        }
    }

    fn left_out(&self, for_events: bool) -> Vec<Skipped> {
        let mut skipped = Vec::new();
        let mut skip = |what, why| skipped.push(Skipped { what, why });
        match self.state {
            State::Nothing => skip("the motion", "no output depends on it"),
            State::Axis | State::AxisAndMomentum => {
                skip("the third angle (e_x)", "the outputs depend on n and L alone, which move by themselves");
            }
            State::Orientation => {}
        }
        if self.state == State::Axis && self.method.is_some_and(Method::is_closed_form) {
            skip("the angular momentum at samples", "the outputs depend on n alone");
        }
        if self.method.is_some_and(Method::is_closed_form) {
            skip("integration", "the motion has a closed form");
            let counts_turns = self.outputs.contains(&Output::EulerAngles);
            if !for_events && !counts_turns {
                skip("times between samples", "a closed form needs no time before the requested one");
            }
        }
        if self.state != State::Nothing && self.samples == 0 {
            skip("samples", "events are found on the dense output, wherever they are");
        }
        if self.derivatives.is_empty() {
            skip("derivatives", "none is requested");
        } else if self.derivatives.len() < Parameter::OF_MOTION.len() {
            skip("derivatives by the other parameters", "only those named are computed");
        }
        skipped
    }

    /// The motion of the plan's problem or, for a computation in segments, from a later state of it; with or without `e_x`, like the
    /// problem.
    ///
    /// # Errors
    /// As for [`Problem::taylor`], or for the closed form chosen; [`Error::Unsupported`] for a problem with `e_x` if the plan does not
    /// carry `e_x`.
    pub fn motion<X: RotationState<f64>>(&self, problem: &Problem<f64, X>) -> Result<PlannedMotion<X>, Error> {
        if X::VECTORS == 3 && self.state != State::Orientation {
            return Err(Error::Unsupported { what: "motion with e_x", why: "no output of the plan needs it" });
        }
        let none = Error::Unsupported { what: "motion of the plan", why: "none of its outputs needs one" };
        problem.motion_by(self.method.ok_or(none)?, self.span, self.tolerance)
    }

    /// Whether the cost of a time does not depend on the number of turns before it: in closed form, and without events or turns
    /// to be counted.
    pub fn costs_the_same_at_any_time(&self) -> bool {
        let counts = |output: &Output| {
            matches!(output.need().evaluations, Evaluations::CountingTurns { .. } | Evaluations::ForEvents { .. })
        };
        self.method.is_none_or(Method::is_closed_form) && !self.outputs.iter().any(counts)
    }
}

/// Upper estimate of the rotation rate of directions.
fn turning_rate<X: RotationState<f64>>(problem: &Problem<f64, X>) -> f64 {
    let (spheroid, AxisState { axis, momentum }) = (problem.spheroid(), problem.initial().axis_state());
    let omega = angular_velocity(spheroid, &axis, &momentum).norm();
    omega.max(momentum.norm() / spheroid.inertia_xx)
        + (2.0 * largest_torque(spheroid, problem.coefficients()) / spheroid.inertia_xx).sqrt()
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};

    use super::*;
    use crate::dynamics::RigidSpheroid;
    use crate::dynamics::fixture::problem;
    use crate::propagation::Motion;

    const S: [f64; 3] = [0.02, 0.01, -0.03];

    /// The plan for one output, with seven samples.
    fn plan(output: Output, method: Option<Method>) -> Plan {
        problem(S).plan(&Request { method, ..Request::new(&[output], (0.0, 50.0), 7, 1e-9) }).unwrap()
    }

    #[test]
    fn rounding_up_to_a_hundred_times_the_least_is_admitted() {
        let mut plan = plan(Output::SymmetryAxis, Some(Method::Taylor));
        let with_rounding = |rounding| Prediction { truncation: 0.0, rounding, ..plan.prediction.unwrap() };
        let (best, admitted, refused) = (with_rounding(1.0), with_rounding(99.7), with_rounding(100.3));
        plan.considered = vec![Candidate { method: Method::Taylor, prediction: Ok(best) }];
        assert!(plan.admits(&best) && plan.admits(&admitted) && !plan.admits(&refused));
        plan.tolerance = 100.4;
        assert!(plan.admits(&refused));
    }

    /// If every method that meets the tolerance loses `lost` to rounding, a method with a truncation error up to `lost` is no worse. A method that is
    /// compared with no other must meet the tolerance.
    #[test]
    fn a_truncation_above_the_tolerance_is_admitted_below_the_rounding_of_the_others() {
        let mut plan = plan(Output::SymmetryAxis, Some(Method::Taylor));
        let lost = 3e-6;
        let with = |truncation, rounding| Prediction { truncation, rounding, ..plan.prediction.unwrap() };
        let (meets, misses) = (with(1e-9, lost), with(0.9 * lost, 1e-9));
        let [unknown, too_far] = [with(0.1 * lost, f64::NAN), with(1.1 * lost, 1e-9)];
        let considered = |all: &[Prediction]| {
            all.iter().map(|one| Candidate { method: Method::Averaged, prediction: Ok(*one) }).collect::<Vec<_>>()
        };
        plan.considered = considered(&[misses, too_far]);
        assert!(!plan.admits(&misses));
        plan.considered = considered(&[meets, misses, unknown, too_far]);
        assert!(plan.admits(&meets) && plan.admits(&misses) && !plan.admits(&unknown) && !plan.admits(&too_far));
        // A method that misses the tolerance can be far more accurate than all that meet it.
        plan.considered = considered(&[meets, with(lost / 101.0, 1e-9)]);
        assert!(!plan.admits(&meets));
        plan.tolerance = 4e-6;
        assert!(plan.admits(&meets) && plan.admits(&misses) && plan.admits(&too_far));
    }

    #[test]
    fn a_star_with_a_bulge_has_the_averaged_motion_alone() {
        let star = |s: [f64; 3]| problem(s).with_bulge(0.2).unwrap();
        let request = Request::new(&[Output::EquatorialAxis], (0.0, 50.0), 7, 1e-9);
        let weak = star([2e-6, 1e-6, -3e-6]);
        assert_eq!(weak.plan(&request).unwrap().method, Some(Method::Averaged));
        let refused = |problem: &Problem<f64>, request: &Request| match problem.plan(request) {
            Err(Error::Domain { quantity, .. }) => quantity,
            other => panic!("{other:?}"),
        };
        assert!(refused(&star([0.02, 0.01, -0.03]), &request).starts_with("truncation error of the averaged motion"));
        assert!(refused(&star([0.7, 0.1, -0.8]), &request).starts_with("|C| (s_max"));
        assert!(refused(&weak.with_bulge(1e6).unwrap(), &request).ends_with("with a bulge"));
        for method in [Method::Steady, Method::Symmetric, Method::Torus, Method::Splitting, Method::Taylor] {
            assert!(matches!(weak.motion_by(method, (0.0, 1.0), 1e-9), Err(Error::Unsupported { .. })), "{method:?}");
            let forced = Request { method: Some(method), ..request.clone() };
            assert!(matches!(weak.plan(&forced), Err(Error::Unsupported { .. })), "{method:?}");
        }
        let free = Request { method: Some(Method::Free), ..request };
        assert_eq!(weak.plan(&free).unwrap().method, Some(Method::Free));
        let derivatives = Request { derivatives: vec![Parameter::Beta], ..free };
        assert!(matches!(weak.plan(&derivatives), Err(Error::Unsupported { .. }) | Err(Error::Domain { .. })));
        // Free rotation neglects the bulge, and includes it in its bound.
        let [free, averaged] =
            [Method::Free, Method::Averaged].map(|method| weak.motion_by(method, (0.0, 50.0), 1e-9).unwrap());
        let off = (free.state(50.0).unwrap().axis - averaged.state(50.0).unwrap().axis).norm();
        let rigid = problem([2e-6, 1e-6, -3e-6]).motion_by(Method::Free, (0.0, 50.0), 1e-9).unwrap();
        assert!(off < free.error_estimate(50.0), "{off:e}");
        assert!(free.error_estimate(50.0) > rigid.error_estimate(50.0) + 1e-5);
    }

    #[test]
    fn a_plan_without_a_motion_tells_that_no_output_needs_one() {
        let motion = plan(Output::PerturbationAngles, None).motion(&problem(S).reduced());
        let Err(Error::Unsupported { why, .. }) = motion else { panic!("{motion:?}") };
        assert_eq!(why, "none of its outputs needs one");
    }

    /// A series on the torus costs more than the averaged motion, and is tried if the averaged motion loses a hundred times the tolerance
    /// to rounding.
    #[test]
    fn the_torus_is_tried_where_the_cheapest_method_loses_too_much() {
        let weak = problem([2e-9, 1e-9, -3e-9]);
        let request = |tolerance| Request::new(&[Output::SymmetryAxis], (0.0, 1e7), 1, tolerance);
        let averaged = weak.plan(&request(1e-6)).unwrap();
        assert_eq!(averaged.method, Some(Method::Averaged));
        let rounding = averaged.prediction.unwrap().rounding;
        let is_tried = |tolerance| {
            let considered = weak.plan(&request(tolerance)).unwrap().considered;
            considered.iter().any(|candidate| candidate.method == Method::Torus)
        };
        assert!(!is_tried(rounding / 90.0) && is_tried(rounding / 110.0), "{rounding:e}");
    }

    #[test]
    fn times_between_samples_are_left_out_of_closed_forms_but_for_events_and_turns() {
        let left_out = |output| {
            let request = Request { method: Some(Method::Averaged), ..Request::new(&[output], (0.0, 50.0), 7, 1e-9) };
            let plan = problem([2e-7, 1e-7, -3e-7]).plan(&request).unwrap();
            plan.skipped.iter().any(|skipped| skipped.what == "times between samples")
        };
        assert!(left_out(Output::SymmetryAxis) && left_out(Output::AngularMomentum));
        assert!(!left_out(Output::EulerAngles) && !left_out(Output::Pulses));
    }

    /// For a slender body that rotates about its axis: `L / I^zz`, which is more than `L / I^xx`.
    #[test]
    fn directions_turn_at_most_as_fast_as_the_body() {
        let spheroid = RigidSpheroid { inertia_xx: 1.0, inertia_zz: 0.5, constant_c: 0.7 };
        let initial = AxisState { axis: Vector3::z(), momentum: Vector3::z() * 2.0 };
        let rate = |s: Matrix3<f64>| turning_rate(&Problem::new(spheroid, s, initial).unwrap());
        assert_eq!(rate(Matrix3::zeros()), 4.0);
        // The largest torque is C times the range of the eigenvalues.
        let more = rate(Matrix3::from_diagonal(&Vector3::new(0.3, 0.0, -0.3))) - 4.0;
        assert!((more - (2.0_f64 * 0.7 * 0.6).sqrt()).abs() < 1e-14, "{more}");
    }

    #[test]
    fn the_way_back_costs_what_the_way_there_does() {
        let cost = |span: (f64, f64)| {
            let request = Request { method: Some(Method::Taylor), ..Request::new(&[Output::Pulses], span, 7, 1e-9) };
            problem(S).plan(&request).unwrap().prediction.unwrap().cost
        };
        assert_eq!(cost((0.0, 50.0)), cost((50.0, 0.0)));
    }
}
