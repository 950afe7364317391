//! Plans: method, prediction, omitted methods, and counted work.

use std::collections::BTreeSet;

use nalgebra::Matrix3;
use twofold::parameters::Parameter;
use twofold::plan::{Cost, Counted, Method, Output, Plan, Request, State};
use twofold::propagation::{Motion, largest_torque};

use crate::values::scene::{STAR, general, problem, tensor};
use crate::values::table::Table;

/// A table of plans, with the reasons for omissions at its end.
#[derive(Default)]
struct Plans {
    table: Table,
    skipped: BTreeSet<String>,
}

impl Plans {
    /// The plan in a sentence, and predictions of the methods considered.
    fn add(&mut self, name: &str, request: &Request, s: &Matrix3<f64>, with_candidates: impl FnOnce(&Plan) -> bool) {
        self.table.found(name, problem(*s).plan(request), |table, plan| {
            let (state, method) = (plan.state.name(), plan.method.map_or("no method", Method::name));
            let cost = if plan.costs_the_same_at_any_time() { "the same at any time" } else { "by steps" };
            let skipped: Vec<_> = plan.skipped.iter().map(|skipped| skipped.what).collect();
            self.skipped.extend(plan.skipped.iter().map(|skipped| format!("{}: {}", skipped.what, skipped.why)));
            let text = format!("{state} by {method}, cost {cost}, to {:?}, samples {}", plan.span.1, plan.samples);
            table.row(name, format_args!("{text}, without {}", skipped.join(", ")));
            if !with_candidates(&plan) {
                return;
            }
            for candidate in &plan.considered {
                let name = format!("  {}", candidate.method.name());
                table.found(&name, candidate.prediction.clone(), |table, found| {
                    let admitted = if plan.admits(&found) { "admitted" } else { "not admitted" };
                    // Part of the rounding is that of the given state.
                    let (truncation, rounding) = (found.truncation, found.rounding.log2().round());
                    let text = format!("{admitted}, truncation {truncation:?}, rounding 2 to the {rounding}");
                    let (order, bytes, cost, work) =
                        (found.order, found.memory.of_a_segment(1), found.cost, found.work);
                    let text = format!("{text}, order {order}, bytes {bytes:?}, cost {cost:?}, steps {:?}", work.steps);
                    table.row(&name, format_args!("{text}, evaluations {:?}", work.evaluations()));
                });
            }
        });
    }

    fn check(mut self, name: &str) {
        for skipped in self.skipped {
            self.table.row("left out", format_args!("{skipped}"));
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
                name == "general" && states.insert((plan.state, plan.samples))
            });
        }
    }
    plans.check("plans_of_outputs");
}

/// Other spans, tolerances and derivatives; and methods requested by name, which are used whatever their error, or refused.
#[test]
fn long_and_forced() {
    let mut plans = Plans::default();
    let both = [Output::SymmetryAxis, Output::FirstIntegrals];
    let usual = Request::new(&both, (0.0, 500.0), 40, 1e-6);
    let derivatives = vec![Parameter::InertiaZz, Parameter::Alpha];
    let some = Request { derivatives, ..usual.clone() };
    let requests = [
        ("usual", usual.clone()),
        ("some", some.clone()),
        ("long", Request::new(&both, (0.0, 1e8), 40, 1e-6)),
        ("tensors", Request { derivatives: vec![Parameter::S(0, 1)], ..usual.clone() }),
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
        for (what, request) in &requests[..if scene == "general" { 6 } else { 3 }] {
            plans.add(&format!("{scene}, {what}"), request, &s, |_| ["general", "symmetric"].contains(&scene));
        }
        for method in [Method::Free, Method::Steady, Method::Symmetric, Method::Averaged, Method::Splitting] {
            for (what, request) in [("usual", &usual), ("some", &some)] {
                let plan = problem(s).plan(&Request { method: Some(method), ..request.clone() });
                let name = format!("{scene}, {what}, {} by name", method.name());
                plans.table.result(&name, plan.map(|plan| plan.method));
            }
        }
        plans.table.row(scene, format_args!("largest torque {:?}", largest_torque(&STAR, &s)));
    }
    plans.check("plans_long_and_forced");
}

#[test]
fn costs_and_counts() {
    let mut table = Table::default();
    for method in Method::ALL {
        for state in [State::Nothing, State::Axis, State::AxisAndMomentum, State::Orientation] {
            let (name, cost) = (format!("{}, {}", method.name(), state.name()), Cost::of(method, state));
            table.row(&name, format_args!("{cost:?}, order 14, 30 steps, 7 times {:?}", cost.total(14, 30.0, 7.0)));
        }
        table.row(method.name(), method.description());
        assert_eq!(Method::named(method.name()), Some(method));
    }
    assert_eq!(Method::named("euler"), None);
    let counted = Counted::new(problem(general()).taylor((0.0, 9.0), 1e-9).expect("a motion"));
    for t in [1.0, 2.0, 3.0] {
        counted.axis_state(t).expect("a state");
    }
    counted.axis_state_in_parts([1.0, 2.0]).expect("a state");
    counted.state(4.0).expect("a state");
    counted.state_in_parts([1.0, 2.0]).expect("a state");
    table.row("counted", counted.evaluations());
    let plan = |output| problem(general()).plan(&Request::new(&[output], (0.0, 9.0), 3, 1e-9)).expect("a plan");
    let (axis, none) = (plan(Output::SymmetryAxis), plan(Output::PerturbationAngles));
    for (name, motion) in [
        ("orientation of a plan for the axis", axis.motion(&problem(general())).map(|motion| motion.work())),
        ("axis of a plan for the axis", axis.motion(&problem(general()).reduced()).map(|motion| motion.work())),
        ("motion of a plan for none", none.motion(&problem(general()).reduced()).map(|motion| motion.work())),
    ] {
        table.result(name, motion);
    }
    for method in Method::ALL {
        let orientation = problem(general()).motion_by(method, (0.0, 9.0), 1e-9).map(|motion| motion.work());
        let axis = problem(general()).reduced().motion_by(method, (0.0, 9.0), 1e-9).map(|motion| motion.work());
        table.result(&format!("{} with e_x", method.name()), orientation);
        table.result(&format!("{} without e_x", method.name()), axis);
    }
    table.check("costs_and_counts");
}
