//! Plans: method, prediction, what is left out, and what motions count.

use twofold::dynamics::BodyState;
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::parameters::Parameter;
use twofold::plan::{
    Cost, Counted, Method, Output, Plan, PlannedAxisMotion, PlannedMotion, Prediction, Request, Samples, State, Work,
};
use twofold::propagation::{Motion, largest_torque, propagate};

use crate::values::scene::{STAR, general, state, tensor};
use crate::values::table::Table;

fn work(table: &mut Table, name: &str, work: &Work) {
    let Work { steps, right_hand_sides, axis_evaluations, orientation_evaluations } = *work;
    table.row(name, &[steps, right_hand_sides, axis_evaluations, orientation_evaluations, work.evaluations()]);
}

fn plan(table: &mut Table, name: &str, plan: &Plan) {
    let method = plan.method.map_or("no method", Method::name);
    let always = if plan.costs_the_same_at_any_time() { "at any time" } else { "by steps" };
    table.text(name, &format!("{} {method} {always}", plan.state.name()));
    table.row("  stretch, samples, accuracy", &[plan.stretch.0, plan.stretch.1, plan.samples as f64, plan.accuracy]);
    for candidate in &plan.considered {
        let name = format!("  {}", candidate.method.name());
        match &candidate.prediction {
            Ok(found) => {
                let admitted = f64::from(u8::from(plan.admits(found)));
                let Prediction { truncation, rounding, order, bytes, cost, .. } = *found;
                // Of the rounding, part of which is that of the state given, its power of two.
                table.row(&name, &[admitted, truncation, rounding.log2().round(), order as f64, bytes, cost]);
                work(table, &format!("  {}: work", candidate.method.name()), &found.work);
            }
            Err(error) => table.error(&name, error),
        }
    }
    for skipped in &plan.skipped {
        table.text(&format!("  without {}", skipped.what), skipped.why);
    }
}

#[test]
fn requests() {
    let mut table = Table::default();
    let scenes = [("general", general()), ("weak", general() * 1e-9), ("symmetric", tensor([0.02, 0.02, -0.03]))];
    for (name, s) in &scenes {
        for output in Output::ALL {
            let request = Request::new(&[output], (1.0, 40.0), 25, 1e-9);
            match Plan::from_parts(&STAR, s, &state(), &request) {
                Ok(found) => plan(&mut table, &format!("{name}, {}", output.name()), &found),
                Err(error) => table.error(&format!("{name}, {}", output.name()), &error),
            }
        }
    }
    table.check("plans_of_outputs");
}

#[test]
fn long_and_forced() {
    let mut table = Table::default();
    let both = [Output::SymmetryAxis, Output::FirstIntegrals];
    let usual = Request::new(&both, (0.0, 500.0), 40, 1e-6);
    let cut = Request { samples: Samples { count: 7, last: 30.0 }, ..usual.clone() };
    let some = Request { derivatives: vec![Parameter::InertiaZz, Parameter::Alpha], ..usual.clone() };
    let tensors = Request { derivatives: vec![Parameter::S(0, 1)], ..usual.clone() };
    let long = Request::new(&both, (0.0, 1e8), 40, 1e-6);
    let backwards = Request::new(&both, (0.0, -300.0), 40, 1e-12);
    let events = Request::new(&[Output::Pulses, Output::EulerAngles], (0.0, 200.0), 10, 1e-8);
    let scenes = [
        ("general", general()),
        ("weak", general() * 1e-9),
        ("none", general() * 0.0),
        ("symmetric", tensor([0.02, 0.02, -0.03])),
        ("nearly symmetric", tensor([0.02, 0.02 + 1e-8, -0.03])),
    ];
    for (name, s) in &scenes {
        for (what, request) in [
            ("usual", &usual),
            ("cut", &cut),
            ("some", &some),
            ("tensors", &tensors),
            ("long", &long),
            ("backwards", &backwards),
            ("events", &events),
        ] {
            let forced =
                [Method::Free, Method::Steady, Method::Symmetric, Method::Averaged, Method::Splitting].map(Some);
            let named = if ["usual", "some"].contains(&what) { &forced[..] } else { &[] };
            for method in [None].iter().chain(named).copied() {
                let request = Request { method, ..request.clone() };
                let name = format!("{name}, {what}, {method:?}");
                match Plan::from_parts(&STAR, s, &state(), &request) {
                    Ok(found) => plan(&mut table, &name, &found),
                    Err(error) => table.error(&name, &error),
                }
            }
        }
        table.number(&format!("{name}: largest torque"), largest_torque(&STAR, s));
    }
    table.check("plans_long_and_forced");
}

#[test]
fn costs_and_counts() {
    let mut table = Table::default();
    for method in Method::ALL {
        for state in [State::Nothing, State::Axis, State::AxisAndMomentum, State::Orientation] {
            let Cost { setup, step, evaluation } = Cost::of(method, state);
            table.parts(
                &format!("{} {}", method.name(), state.name()),
                [setup, step[0], step[1], step[2], evaluation[0], evaluation[1]],
            );
            table.number(
                &format!("{} {}: total", method.name(), state.name()),
                Cost::of(method, state).total(14, 30.0, 7.0),
            );
        }
        table.text(method.name(), method.description());
        assert_eq!(Method::named(method.name()), Some(method));
    }
    assert_eq!(Method::named("euler"), None);
    let symmetric = tensor([0.02, 0.02, -0.03]);
    let resting = BodyState { momentum: state().axis * 2.0, ..state() };
    for method in Method::ALL {
        let (s, initial) = match method {
            Method::Steady => (PrincipalCoefficients::new([0.0; 3]).tensor(), resting),
            Method::Symmetric => (symmetric, state()),
            _ => (general(), state()),
        };
        match PlannedMotion::by(method, &STAR, &s, &initial, (0.0, 9.0), 1e-9) {
            Ok(motion) => {
                work(&mut table, &format!("orientation by {}", method.name()), &motion.work());
                table.state(method.name(), &motion.state(8.0).expect("a state"));
                table.number(&format!("{}: error estimate", method.name()), motion.error_estimate(8.0));
            }
            Err(error) => table.error(method.name(), &error),
        }
        match PlannedAxisMotion::axis_by(method, &STAR, &s, &initial, (0.0, 9.0), 1e-9) {
            Ok(motion) => {
                work(&mut table, &format!("axis by {}", method.name()), &motion.work());
                table.axis_state(method.name(), &motion.axis_state(8.0).expect("a state"));
            }
            Err(error) => table.error(method.name(), &error),
        }
    }
    let counted = Counted::new(propagate(&STAR, &general(), &state(), (0.0, 9.0), 1e-9).expect("a motion"));
    for t in [1.0, 2.0, 3.0] {
        counted.axis_state(t).expect("a state");
    }
    counted.axis_state_in_parts([1.0, 2.0]).expect("a state");
    counted.state(4.0).expect("a state");
    counted.state_in_parts([1.0, 2.0]).expect("a state");
    work(&mut table, "counted", &counted.evaluations());
    let plan =
        Plan::from_parts(&STAR, &general(), &state(), &Request::new(&[Output::SymmetryAxis], (0.0, 9.0), 3, 1e-9))
            .expect("a plan");
    table.refusal("orientation of a plan for the axis", &plan.motion_from_parts(&STAR, &general(), &state()));
    table.refusal("axis of a plan for the axis", &plan.axis_motion(&STAR, &general(), &state()));
    let none = Plan::from_parts(
        &STAR,
        &general(),
        &state(),
        &Request::new(&[Output::PerturbationAngles], (0.0, 9.0), 3, 1e-9),
    )
    .expect("a plan");
    table.refusal("motion of a plan for none", &none.axis_motion(&STAR, &general(), &state()));
    table.check("costs_and_counts");
}
