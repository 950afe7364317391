//! `--explain`: the plan of a computation, and nothing computed.

use std::fmt::Write;

use twofold::plan::{Candidate, MACHINE, Plan, State};

use crate::scene_file::Scene;

/// The plan as text.
pub(super) fn explained(scene: &Scene, plan: &Plan) -> String {
    let mut text = String::new();
    let time = scene.units.time_name;
    let in_output = |t: f64| scene.times.start() + t * scene.units.time;
    let mut row =
        |name: &str, value: String| writeln!(text, "{name:<13}{value}").expect("writing to a string succeeds");
    row("outputs", plan.outputs.iter().map(|output| output.name()).collect::<Vec<_>>().join(", "));
    row("state", plan.state.name().to_owned());
    row(
        "method",
        match plan.method {
            None => "none: no output needs a motion".to_owned(),
            Some(method) if plan.forced => format!("{} ({}), as asked", method.name(), method.description()),
            Some(method) => format!("{} ({})", method.name(), method.description()),
        },
    );
    if let Some(why) = why(plan) {
        row("why", why);
    }
    let (from, to) = (in_output(plan.stretch.0), in_output(plan.stretch.1));
    let closed = plan.method.is_none_or(|method| method.is_closed_form());
    row(
        "stretch",
        match plan.state {
            State::Nothing => "none".to_owned(),
            _ if closed => format!("none is integrated; times up to {to:?} {time}"),
            _ => format!("{from:?} to {to:?} {time}"),
        },
    );
    row(
        "samples",
        match plan.samples {
            0 => "none".to_owned(),
            samples => samples.to_string(),
        },
    );
    row(
        "derivatives",
        match plan.derivatives.as_slice() {
            [] => "none".to_owned(),
            names => names.iter().map(|parameter| parameter.name()).collect::<Vec<_>>().join(", "),
        },
    );
    if let Some(prediction) = &plan.prediction {
        let work = &prediction.work;
        if prediction.order > 0 {
            let (steps, order) = (work.steps, prediction.order);
            row("steps", format!("about {steps:.0} of order {order}: {:.0} right-hand sides", work.right_hand_sides));
        }
        row("evaluations", format!("about {:.0} of {}", work.evaluations(), plan.state.name()));
        row("memory", format!("about {}", bytes(prediction.bytes)));
        row("cost", format!("about {} on {MACHINE}", duration(prediction.cost)));
        row(
            "error",
            format!(
                "at most {:.1e} by the method, about {:.1e} by rounding; asked is {:.0e}",
                prediction.truncation, prediction.rounding, plan.accuracy
            ),
        );
    }
    let mut line = |line: std::fmt::Arguments<'_>| writeln!(text, "{line}").expect("writing to a string succeeds");
    line(format_args!("\nskipped"));
    for skipped in &plan.skipped {
        line(format_args!("  {}: {}", skipped.what, skipped.why));
    }
    if !plan.considered.is_empty() {
        line(format_args!("\nmethods considered"));
    }
    for Candidate { method, prediction } in &plan.considered {
        let name = method.name();
        match prediction {
            Ok(prediction) if plan.admits(prediction) => {
                line(format_args!("  {name}: {}, error {:.1e}", duration(prediction.cost), prediction.truncation));
            }
            Ok(prediction) if prediction.truncation <= plan.accuracy => {
                line(format_args!(
                    "  {name}: loses digits that another keeps, {:.1e} by rounding",
                    prediction.rounding
                ));
            }
            Ok(prediction) => {
                line(format_args!("  {name}: not accurate enough, error up to {:.1e}", prediction.truncation));
            }
            Err(why) => line(format_args!("  {name}: not possible: {why}")),
        }
    }
    text
}

/// Why the method was taken, against the next best that meets the accuracy.
fn why(plan: &Plan) -> Option<String> {
    let (method, prediction) = (plan.method?, plan.prediction?);
    if plan.forced {
        return None;
    }
    let usable = plan.considered.iter().filter(|candidate| candidate.method != method).filter_map(|candidate| {
        let other = candidate.prediction.as_ref().ok()?;
        plan.admits(other).then_some((candidate.method, other.cost))
    });
    let next = usable.min_by(|a, b| a.1.total_cmp(&b.1));
    let found = format!("the cheapest of those whose error is below {:.0e}", plan.accuracy);
    Some(match next {
        Some((other, cost)) => {
            format!("{found}; next is {}, {:.1} times the cost", other.name(), cost / prediction.cost)
        }
        None => format!("{found}, and the only one"),
    })
}

fn duration(ns: f64) -> String {
    match ns {
        ns if ns < 1e3 => format!("{ns:.0} ns"),
        ns if ns < 1e6 => format!("{:.1} us", ns / 1e3),
        ns if ns < 1e9 => format!("{:.1} ms", ns / 1e6),
        ns => format!("{:.1} s", ns / 1e9),
    }
}

pub(super) fn bytes(count: f64) -> String {
    match count {
        count if count < 1e3 => format!("{count:.0} bytes"),
        count if count < 1e6 => format!("{:.1} kB", count / 1e3),
        count if count < 1e9 => format!("{:.1} MB", count / 1e6),
        count if count < 1e12 => format!("{:.1} GB", count / 1e9),
        count => format!("{:.1} TB", count / 1e12),
    }
}
