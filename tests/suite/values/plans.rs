//! Plans: method, prediction, what is left out, and what motions count.

use std::collections::BTreeSet;

use nalgebra::Matrix3;
use twofold::dynamics::{BodyState, Problem};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::parameters::Parameter;
use twofold::plan::{Cost, Counted, Method, Output, Plan, Request, Samples, State, Work};
use twofold::propagation::{Motion, largest_torque};

use crate::values::scene::{STAR, general, state, tensor};
use crate::values::table::{Table, Written};

/// `41 steps, 82 right-hand sides, 25 axes`: what there is of it.
impl Written for Work {
    fn written(&self) -> String {
        let Work { steps, right_hand_sides, axis_evaluations, orientation_evaluations } = *self;
        assert_eq!(self.evaluations(), axis_evaluations + orientation_evaluations);
        [
            (steps, "steps"),
            (right_hand_sides, "right-hand sides"),
            (axis_evaluations, "axes"),
            (orientation_evaluations, "orientations"),
        ]
        .iter()
        .filter(|(count, _)| *count != 0.0)
        .map(|(count, of)| format!("{} {of}", count.written()))
        .collect::<Vec<_>>()
        .join(", ")
    }
}

/// A table of plans, with the reasons for what is left out at its end.
#[derive(Default)]
struct Plans {
    table: Table,
    skipped: BTreeSet<String>,
}

impl Plans {
    /// What is computed, in a sentence; and predictions of the methods that were considered.
    fn add(&mut self, name: &str, request: &Request, s: &Matrix3<f64>, with_candidates: impl FnOnce(&Plan) -> bool) {
        self.table.found(
            name,
            Problem::new(STAR, *s, state()).and_then(|problem| problem.plan(request)),
            |table, plan| {
                let method = plan.method.map_or("no method", Method::name);
                let cost = if plan.costs_the_same_at_any_time() { "the same at any time" } else { "by steps" };
                let skipped: Vec<_> = plan.skipped.iter().map(|skipped| skipped.what).collect();
                self.skipped.extend(plan.skipped.iter().map(|skipped| format!("{}: {}", skipped.what, skipped.why)));
                let stretch = format!("{} to {}", plan.span.0, plan.span.1);
                table.row(
                    name,
                    &[
                        ("", &format!("{} by {method}", plan.state.name())),
                        ("cost", &cost),
                        ("stretch", &stretch),
                        ("samples", &plan.samples),
                        ("tolerance", &plan.tolerance),
                        ("without", &skipped.join(", ")),
                    ],
                );
                if !with_candidates(&plan) {
                    let names: Vec<_> = plan.considered.iter().map(|candidate| candidate.method.name()).collect();
                    return table.row("  considered", &[("", &names.join(", "))]);
                }
                for candidate in &plan.considered {
                    let name = format!("  {}", candidate.method.name());
                    table.found(&name, candidate.prediction.clone(), |table, found| {
                        table.row(
                            &name,
                            &[
                                ("", &if plan.admits(&found) { "admitted" } else { "not admitted" }),
                                ("truncation", &found.truncation),
                                // Part of which is that of the state given.
                                ("rounding 2 to the", &(found.rounding.log2().round() as i64)),
                                ("order", &found.order),
                                ("bytes", &found.bytes),
                                ("cost", &found.cost),
                                ("", &found.work),
                            ],
                        );
                    });
                }
            },
        );
    }

    fn check(mut self, name: &str) {
        for skipped in self.skipped {
            self.table.row("left out", &[("", &skipped)]);
        }
        self.table.check(name);
    }
}

#[test]
fn requests() {
    let mut plans = Plans::default();
    for (name, s) in [("general", general()), ("weak", general() * 1e-9), ("symmetric", tensor([0.02, 0.02, -0.03]))] {
        let mut states = BTreeSet::new();
        for output in Output::ALL {
            let request = Request::new(&[output], (1.0, 40.0), 25, 1e-9);
            plans.add(&format!("{name}, {}", output.name()), &request, &s, |plan| {
                states.insert((plan.state, plan.samples))
            });
        }
    }
    plans.check("plans_of_outputs");
}

#[test]
fn long_and_forced() {
    let mut plans = Plans::default();
    let both = [Output::SymmetryAxis, Output::FirstIntegrals];
    let usual = Request::new(&both, (0.0, 500.0), 40, 1e-6);
    let derivatives = vec![Parameter::InertiaZz, Parameter::Alpha];
    let requests = [
        ("usual", usual.clone()),
        ("cut", Request { samples: Samples { count: 7, last: 30.0 }, ..usual.clone() }),
        ("some", Request { derivatives, ..usual.clone() }),
        ("tensors", Request { derivatives: vec![Parameter::S(0, 1)], ..usual }),
        ("long", Request::new(&both, (0.0, 1e8), 40, 1e-6)),
        ("backwards", Request::new(&both, (0.0, -300.0), 40, 1e-12)),
        ("events", Request::new(&[Output::Pulses, Output::EulerAngles], (0.0, 200.0), 10, 1e-8)),
    ];
    for (scene, s) in [
        ("general", general()),
        ("weak", general() * 1e-9),
        ("none", general() * 0.0),
        ("symmetric", tensor([0.02, 0.02, -0.03])),
        ("nearly symmetric", tensor([0.02, 0.02 + 1e-8, -0.03])),
    ] {
        for (what, request) in &requests {
            let named =
                [Method::Free, Method::Steady, Method::Symmetric, Method::Averaged, Method::Splitting].map(Some);
            let named = if ["usual", "some"].contains(what) { &named[..] } else { &[] };
            for method in [None].iter().chain(named).copied() {
                let request = Request { method, ..request.clone() };
                let name = format!("{scene}, {what}, {}", method.map_or("any method", Method::name));
                plans.add(&name, &request, &s, |_| method.is_none() && ["general", "symmetric"].contains(&scene));
            }
        }
        plans.table.row(scene, &[("largest torque", &largest_torque(&STAR, &s))]);
    }
    plans.check("plans_long_and_forced");
}

#[test]
fn costs_and_counts() {
    let mut table = Table::default();
    for method in Method::ALL {
        for state in [State::Nothing, State::Axis, State::AxisAndMomentum, State::Orientation] {
            let cost = Cost::of(method, state);
            let numbers = |all: &[f64]| all.iter().map(|x| x.to_string()).collect::<Vec<_>>().join(" ");
            table.row(
                &format!("{}, {}", method.name(), state.name()),
                &[
                    ("setup", &cost.setup),
                    ("step", &numbers(&cost.step)),
                    ("evaluation", &numbers(&cost.evaluation)),
                    ("of order 14, 30 steps, 7 times", &cost.total(14, 30.0, 7.0)),
                ],
            );
        }
        table.row(method.name(), &[("", &method.description())]);
        assert_eq!(Method::named(method.name()), Some(method));
    }
    assert_eq!(Method::named("euler"), None);
    let resting = BodyState { momentum: state().axis * 2.0, ..state() };
    for method in Method::ALL {
        let (s, initial) = match method {
            Method::Steady => (PrincipalCoefficients::new([0.0; 3]).tensor(), resting),
            Method::Symmetric => (tensor([0.02, 0.02, -0.03]), state()),
            _ => (general(), state()),
        };
        let name = format!("orientation by {}", method.name());
        let motion = Problem::new(STAR, s, initial).and_then(|problem| problem.motion_by(method, (0.0, 9.0), 1e-9));
        table.found(&name, motion, |table, motion| {
            let (state, error) = (motion.state(8.0).expect("a state"), motion.error_estimate(8.0));
            table.row(&name, &[("", &motion.work()), ("at 8", &state), ("error", &error)]);
        });
        let name = format!("axis by {}", method.name());
        let motion =
            Problem::new(STAR, s, initial).and_then(|problem| problem.reduced().motion_by(method, (0.0, 9.0), 1e-9));
        table.found(&name, motion, |table, motion| {
            table.row(&name, &[("", &motion.work()), ("at 8", &motion.axis_state(8.0).expect("a state"))]);
        });
    }
    let counted = Counted::new(
        Problem::new(STAR, general(), state()).and_then(|problem| problem.taylor((0.0, 9.0), 1e-9)).expect("a motion"),
    );
    for t in [1.0, 2.0, 3.0] {
        counted.axis_state(t).expect("a state");
    }
    counted.axis_state_in_parts([1.0, 2.0]).expect("a state");
    counted.state(4.0).expect("a state");
    counted.state_in_parts([1.0, 2.0]).expect("a state");
    table.row("counted", &[("", &counted.evaluations())]);
    let plan = |output| {
        let request = Request::new(&[output], (0.0, 9.0), 3, 1e-9);
        Problem::new(STAR, general(), state()).and_then(|problem| problem.plan(&request)).expect("a plan")
    };
    let (axis, none) = (plan(Output::SymmetryAxis), plan(Output::PerturbationAngles));
    table.refusal(
        "orientation of a plan for the axis",
        Problem::new(STAR, general(), state()).and_then(|problem| axis.motion(&problem)),
    );
    table.refusal(
        "axis of a plan for the axis",
        Problem::new(STAR, general(), state()).and_then(|problem| axis.motion(&problem.reduced())),
    );
    table.refusal(
        "motion of a plan for none",
        Problem::new(STAR, general(), state()).and_then(|problem| none.motion(&problem.reduced())),
    );
    table.check("costs_and_counts");
}
