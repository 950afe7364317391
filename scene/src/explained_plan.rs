//! A plan in words: what will be computed, by which method, at what cost, and what is skipped.

use std::fmt::Write;

use twofold::plan::{Candidate, MACHINE, Plan, Prediction, Promise, State};

use crate::estimated_error::{ROUNDING_OF_COMPONENT, as_printed};
use crate::samples::segment_count;
use crate::scene_file::Scene;

/// A plan for outputs of `scene`, as `--explain` prints it.
pub fn explained(scene: &Scene, plan: &Plan) -> String {
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
    let (from, to) = (in_output(plan.span.0), in_output(plan.span.1));
    let closed = plan.method.is_none_or(|method| method.is_closed_form());
    row(
        "span",
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
            names => names.iter().map(|parameter| parameter.symbol()).collect::<Vec<_>>().join(", "),
        },
    );
    if let Some(prediction) = &plan.prediction {
        let work = &prediction.work;
        if prediction.order > 0 {
            let (steps, order) = (work.steps, prediction.order);
            row("steps", format!("about {steps:.0} of order {order}: {:.0} right-hand sides", work.right_hand_sides));
        }
        row("evaluations", format!("about {:.0} of {}", work.evaluations(), plan.state.name()));
        let segments = segment_count(scene, plan);
        let at_a_time = match segments {
            1 => String::new(),
            count => format!(" at a time, in {count} segments of the span"),
        };
        row("memory", format!("about {}{at_a_time}", bytes(prediction.memory.of_a_segment(segments))));
        row("cost", format!("about {} on {MACHINE}", duration(prediction.cost)));
        row(
            "error",
            format!(
                "{} by the method{}; asked is {:.0e}",
                foreseen(prediction),
                meaning(prediction.promise),
                plan.tolerance
            ),
        );
        let rounding = as_printed(prediction.rounding, ROUNDING_OF_COMPONENT);
        row("rounding", format!("about {rounding:.1e}, as the motion's error estimate will count it"));
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
                line(format_args!("  {name}: {}, error {}", duration(prediction.cost), foreseen(prediction)));
            }
            Ok(prediction) if prediction.truncation <= plan.tolerance => {
                let rounding = prediction.rounding;
                line(format_args!("  {name}: loses digits that another keeps, about {rounding:.1e} by rounding"));
            }
            Ok(prediction) => {
                line(format_args!("  {name}: not accurate enough, error {}", foreseen(prediction)));
            }
            Err(why) => line(format_args!("  {name}: not possible: {why}")),
        }
    }
    text
}

/// The predicted error of the method, without rounding.
fn foreseen(prediction: &Prediction) -> String {
    let word = match prediction.promise {
        Promise::Bound => "at most",
        Promise::Estimate => "estimated",
        Promise::Goal(_) => "goal",
    };
    format!("{word} {:.1e}", as_printed(prediction.truncation, ROUNDING_OF_COMPONENT))
}

/// The meaning of the word for the error.
fn meaning(promise: Promise) -> String {
    match promise {
        Promise::Bound => ", which is proved".to_owned(),
        Promise::Estimate => ", which no random motion of its test exceeded".to_owned(),
        Promise::Goal(share) => format!(", which {:.0} % of random motions stay below", 100.0 * share),
    }
}

/// The reason for the choice of the method, compared with the next best one that meets the tolerance.
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
    let asked = format!("whose predicted error is at most {:.0e}", plan.tolerance);
    let found = if prediction.truncation <= plan.tolerance {
        format!("the cheapest of those {asked}")
    } else {
        format!("those {asked} lose more than its error to rounding")
    };
    Some(match next {
        Some((other, cost)) => {
            format!("{found}; next is {}, {:.1} times the cost", other.name(), cost / prediction.cost)
        }
        None => format!("{found}; there is no other"),
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

/// A number of bytes, to a tenth of its unit.
pub fn bytes(count: f64) -> String {
    match count {
        count if count < 1e3 => format!("{count:.0} bytes"),
        count if count < 1e6 => format!("{:.1} kB", count / 1e3),
        count if count < 1e9 => format!("{:.1} MB", count / 1e6),
        count if count < 1e12 => format!("{:.1} GB", count / 1e9),
        count => format!("{:.1} TB", count / 1e12),
    }
}

#[cfg(test)]
mod tests {
    use twofold::parameters::Parameter;
    use twofold::plan::{Memory, Method, Output, Skipped, Work};

    use super::*;

    const OF_TAYLOR: Prediction = Prediction {
        truncation: 2e-9,
        promise: Promise::Goal(0.98),
        rounding: 3e-13,
        order: 20,
        work: Work { steps: 40.0, right_hand_sides: 800.0, axis_evaluations: 3.0, orientation_evaluations: 4.0 },
        memory: Memory { table: 200.0, steps: 40.0, most_stored: 30.0, per_step: 50.0 },
        cost: 1e3,
    };

    /// Every number of an artificial plan appears in its line.
    #[test]
    fn every_number_of_a_plan_is_in_its_line() {
        let mut scene = Scene::named("isolated-pulsar").unwrap();
        scene.units.time = 4.0;
        scene.times = crate::scene_file::Times::Listed { start: 100.0, times: vec![120.0] };
        let candidate = |method, prediction| Candidate { method, prediction: Ok(prediction) };
        let lossy = Prediction { rounding: 2e-3, ..OF_TAYLOR };
        let coarse = Prediction { truncation: 1e-2, promise: Promise::Estimate, ..OF_TAYLOR };
        let bound = Prediction { truncation: 0.0, promise: Promise::Bound, cost: 2.5e3, ..OF_TAYLOR };
        let not_possible = twofold::Error::Unsupported { what: "a motion", why: "there is a torque" };
        let mut plan = Plan {
            outputs: vec![Output::SymmetryAxis, Output::FirstIntegrals],
            state: State::AxisAndMomentum,
            method: Some(Method::Taylor),
            forced: false,
            span: (0.5, 5.0),
            samples: 7,
            derivatives: vec![Parameter::Oblateness, Parameter::Spin],
            tolerance: 1e-6,
            prediction: Some(OF_TAYLOR),
            considered: vec![
                Candidate { method: Method::Free, prediction: Err(not_possible.clone()) },
                candidate(Method::Steady, lossy),
                candidate(Method::Averaged, coarse),
                candidate(Method::Splitting, bound),
                candidate(Method::Taylor, OF_TAYLOR),
            ],
            skipped: vec![Skipped { what: "orientation", why: "no output needs it" }],
        };
        let derivatives = [Parameter::Oblateness, Parameter::Spin].map(Parameter::symbol).join(", ");
        let start = "outputs      symmetry axis, first integrals\nstate        n, L\n";
        let method = "method       taylor (Taylor series with adaptive steps and dense output)";
        // Times are 100 + 4 t; the other method costs 2.5 times as much.
        let rest = format!(
            "span         102.0 to 120.0 s\nsamples      7\nderivatives  {derivatives}\nsteps        about 40 of order 20: 800 right-hand sides\n\
             evaluations  about 7 of n, L\nmemory       about 1.7 kB\ncost         about 1.0 us on {MACHINE}\n\
             error        goal 2.0e-9 by the method, which 98 % of random motions stay below; asked is 1e-6\n\
             rounding     about 3.0e-13, as the motion's error estimate will count it\n\nskipped\n  orientation: no output needs it\n\n\
             methods considered\n  free: not possible: {not_possible}\n  steady: loses digits that another keeps, about 2.0e-3 by rounding\n  \
             averaged: not accurate enough, error estimated 1.0e-2\n  splitting: 2.5 us, error at most 1.1e-16\n  taylor: 1.0 us, error goal 2.0e-9\n"
        );
        let why = "why          the cheapest of those whose predicted error is at most 1e-6; next is splitting, 2.5 times the cost\n";
        assert_eq!(explained(&scene, &plan), format!("{start}{method}\n{why}{rest}"));
        plan.forced = true;
        assert_eq!(explained(&scene, &plan), format!("{start}{method}, as asked\n{rest}"));
        // The rounding error is at least that of a component; a series has at least order one.
        plan.prediction = Some(Prediction { rounding: 0.0, order: 1, ..bound });
        let text = explained(&scene, &plan);
        assert!(text.contains("rounding     about 1.1e-16") && text.contains("of order 1:"), "{text}");
        plan.prediction = Some(Prediction { order: 0, ..bound });
        assert!(!explained(&scene, &plan).contains("\nsteps"));
        // 5.6e4 rad in segments of at most 5e3 rad.
        plan.span.1 = -5.6e4 / scene.turning_rate();
        let memory = Memory { table: 5e5, steps: 120.0, most_stored: f64::INFINITY, per_step: 5e4 };
        plan.prediction = Some(Prediction { memory, ..bound });
        let text = explained(&scene, &plan);
        assert!(text.contains("memory       about 1.0 MB at a time, in 12 segments of the span\n"), "{text}");
        plan = Plan { samples: 0, derivatives: Vec::new(), prediction: None, considered: Vec::new(), ..plan };
        let text = explained(&scene, &plan);
        assert!(text.contains("samples      none\nderivatives  none\n\nskipped\n"), "{text}");
    }

    #[test]
    fn a_unit_begins_where_its_number_is_one() {
        for (ns, text) in [
            (999.0, "999 ns"),
            (1e3, "1.0 us"),
            (9.99e5, "999.0 us"),
            (1e6, "1.0 ms"),
            (1e9, "1.0 s"),
            (1e12, "1000.0 s"),
        ] {
            assert_eq!(duration(ns), text);
        }
        for (count, text) in [
            (999.0, "999 bytes"),
            (1e3, "1.0 kB"),
            (9.99e5, "999.0 kB"),
            (1e6, "1.0 MB"),
            (9.99e8, "999.0 MB"),
            (1e9, "1.0 GB"),
            (9.99e11, "999.0 GB"),
            (1e12, "1.0 TB"),
            (1e15, "1000.0 TB"),
        ] {
            assert_eq!(bytes(count), text);
        }
    }
}
