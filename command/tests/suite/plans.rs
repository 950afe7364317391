//! The counted work of commands: for every group of columns alone and for all together it is not more than the plan lists.

use twofold::plan::{Evaluations, Method, Output, State, Work};
use twofold_scene::scene_file::{BUILT_IN, COLUMN_GROUPS, Scene, Times, column_group};
use twofold_scene::trajectory::{Summary, write_csv, write_pulses};

fn scene(name: &str) -> Scene {
    Scene::named(name).unwrap_or_else(|error| panic!("{error}"))
}

fn with_columns(name: &str, columns: &[Output]) -> Scene {
    let mut scene = scene(name);
    scene.columns = columns.to_vec();
    scene
}

fn written(scene: &Scene) -> Summary {
    write_csv(scene, std::io::sink(), |_| Ok(())).unwrap_or_else(|error| panic!("{error}"))
}

/// Requires `work` to be at most that of the plan of the scene's columns.
fn assert_no_more_than_listed(scene: &Scene, work: &Work, place: &str) {
    let plan = scene.plan(&scene.columns).unwrap_or_else(|error| panic!("{error}"));
    let Some(prediction) = plan.prediction else {
        assert_eq!(*work, Work::default(), "{place}: no motion, no work");
        return;
    };
    let listed = prediction.work;
    assert!(work.right_hand_sides <= 2.0 * listed.right_hand_sides, "{place}: {work:?} for {listed:?}");
    let counts_turns =
        plan.outputs.iter().any(|output| matches!(output.need().evaluations, Evaluations::CountingTurns { .. }));
    if plan.state == State::Orientation {
        assert_eq!(work.axis_evaluations, 0.0, "{place}");
    } else {
        assert_eq!(work.orientation_evaluations, 0.0, "{place}: the third angle is not touched");
    }
    let most = if counts_turns { 2.0 * listed.evaluations() + 16.0 } else { plan.samples as f64 };
    assert!(work.evaluations() <= most, "{place}: {} evaluations, listed {}", work.evaluations(), listed.evaluations());
}

#[test]
fn columns_are_computed_from_no_more_than_the_plan_lists() {
    let mut methods = std::collections::BTreeSet::new();
    for built_in in BUILT_IN {
        let has_what_it_needs = |output: &Output| scene(built_in.name).has_what_is_needed_for(*output).is_ok();
        let available: Vec<_> = COLUMN_GROUPS.map(|(_, output)| output).into_iter().filter(has_what_it_needs).collect();
        let alone = available.iter().map(|group| vec![*group]);
        for groups in alone.chain([available.clone()]) {
            let scene = with_columns(built_in.name, &groups);
            let names: Vec<_> = groups.iter().map(|group| group.name()).collect();
            let summary = written(&scene);
            assert_eq!(summary.rows, scene.times.count());
            assert_no_more_than_listed(&scene, &summary.work, &format!("{} {names:?}", built_in.name));
            methods.extend(scene.plan(&scene.columns).expect("plan").method);
        }
    }
    assert!(methods.contains(&Method::Free) && methods.contains(&Method::Taylor), "{methods:?}");
}

/// The state that each output alone needs, as in docs/plans.md.
#[test]
fn outputs_carry_what_they_need() {
    let state = |group: Output| scene("tp-1").plan(&[group]).expect("plan").state;
    for (names, expected) in [
        (&["perturbation"][..], State::Nothing),
        (&["e_z"], State::Axis),
        (&["rates", "L", "integrals", "lambda", "h"], State::AxisAndMomentum),
        (&["angles", "e_x", "m.n", "magnetic_axis", "position_angle"], State::Orientation),
    ] {
        for name in names {
            assert_eq!(state(column_group(name).expect("group")), expected, "{name}");
        }
    }
    let page = std::fs::read_to_string("../docs/plans.md").expect("docs/plans.md is there");
    for output in Output::ALL {
        let row = format!("| {} | {} |", output.name(), output.need().state.name());
        assert!(page.contains(&row), "docs/plans.md lacks the row {row}");
    }
}

/// One far time: a closed form is evaluated once, at that time; a numerical motion is integrated up to it and evaluated once.
#[test]
fn one_far_time_does_not_pay_for_those_before() {
    for (name, method) in [
        ("free", Method::Free),
        ("axisymmetric-violation", Method::Symmetric),
        ("tp-2", Method::Torus),
        ("sp-2", Method::Taylor),
    ] {
        for column in ["h", "m.n"] {
            let mut scene = with_columns(name, &[column_group(column).expect("group")]);
            scene.times = Times::Listed { start: 0.0, times: vec![1000.0] };
            scene.method = (method == Method::Taylor).then_some(method);
            // Above the rounding after 200 turns, so that a closed form with phases in 32 digits is chosen.
            scene.tolerance = 1e-10;
            let plan = scene.plan(&scene.columns).expect("plan");
            let work = written(&scene).work;
            assert_eq!((plan.method, work.evaluations()), (Some(method), 1.0), "{name}: {column}");
            assert_eq!(method == Method::Taylor, work.right_hand_sides > 0.0);
        }
    }
}

/// The pulses of a scene: evaluations per radian of rotation as listed, within a factor of two.
#[test]
fn pulses_evaluate_as_listed() {
    for name in ["free", "tp-1", "tp-2"] {
        let scene = scene(name);
        let summary = write_pulses(&scene, std::io::sink(), |_| Ok(())).expect("pulses");
        let plan = scene.plan(&[Output::Pulses]).expect("plan");
        let listed = plan.prediction.expect("prediction").work;
        assert_eq!(plan.samples, 0);
        let ratio = summary.work.evaluations() / listed.evaluations();
        assert!(
            (0.25..=2.0).contains(&ratio),
            "{name}: {} evaluations, listed {}",
            summary.work.evaluations(),
            listed.evaluations()
        );
        assert!(summary.work.right_hand_sides <= 2.0 * listed.right_hand_sides);
    }
}

/// A prescribed method is used; one that the scene does not allow is refused with key, value and reason.
#[test]
fn a_method_is_forced_or_refused() {
    let mut tp2 = scene("tp-2");
    tp2.choose_method("free").expect("any scene may be taken as free");
    assert_eq!(tp2.plan(&tp2.columns).expect("plan").method, Some(Method::Free));
    let refused = scene("tp-2").choose_method("steady").expect_err("tp-2 is not steady");
    assert!(refused.contains("two equal eigenvalues"), "{refused}");
    let unknown = scene("tp-2").choose_method("tailor").expect_err("no such method");
    assert!(unknown.contains("Did you mean `taylor`?"), "{unknown}");
    let toml = BUILT_IN.iter().find(|scene| scene.name == "tp-2").expect("tp-2").toml;
    let file = |method: &str| Scene::from_toml("file", &format!("{toml}\n[output]\nmethod = \"{method}\"\n"));
    assert_eq!(file("taylor").expect("scene").method, Some(Method::Taylor));
    for (method, reason) in [
        ("steady", "does not allow"),
        ("tailor", "one of \"free\", \"steady\", \"symmetric\", \"averaged\", \"torus\", \"splitting\", \"taylor\""),
    ] {
        let error = file(method).expect_err("refused").to_string();
        assert!(error.contains("`output.method`") && error.contains(reason), "{error}");
    }
}
