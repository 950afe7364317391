//! `twofold verify`.

use clap::Args;
use std::convert::Infallible;
use std::time::Instant;

use console::Term;

use super::progress::on_all_processors;
use super::{Failure, print, tell};
use twofold_verify::check::Check;
use twofold_verify::{checks, report};

#[derive(Args, Default)]
pub(crate) struct VerifyArgs {
    /// Run only checks whose id contains this text, and describe the number that each measures
    #[arg(long, value_name = "ID")]
    pub(crate) filter: Option<String>,
    /// Print the results as a JSON array instead of tables
    #[arg(long)]
    pub(crate) json: bool,
}

/// Width of the tables if the output is not a terminal.
const WIDTH: u16 = 130;

pub(super) fn verify(args: &VerifyArgs) -> Result<(), Failure> {
    let mut checks = checks::all();
    if let Some(filter) = &args.filter {
        checks.retain(|check| check.id.contains(filter.as_str()));
        if checks.is_empty() {
            let message = format!("no check has an id that contains `{filter}`; `twofold verify` lists them all");
            return Err(Failure::BadInput(message));
        }
    }
    let start = Instant::now();
    let results = run_all(checks);
    if args.json {
        print(&format!("{}\n", report::json(&results)))?;
    } else {
        let width = Term::stdout().size_checked().map_or(WIDTH, |(_, columns)| columns.max(110));
        let summary = report::summary(&results, start.elapsed().as_secs_f64());
        tell(&format!("{}\n{summary}\n", report::tables(&results, width, args.filter.is_some())))?;
    }
    conclude(&results)
}

pub(super) fn conclude(results: &[report::Result]) -> Result<(), Failure> {
    let failed: Vec<_> = results.iter().filter(|(_, outcome)| !outcome.passed).map(|(check, _)| check.id).collect();
    if failed.is_empty() { Ok(()) } else { Err(Failure::Failed(format!("failed checks: {}", failed.join(", ")))) }
}

/// Runs the checks on all processors and returns the results in the order of the list.
pub(super) fn run_all(checks: Vec<Check>) -> Vec<report::Result> {
    let run = |check: &Check| Ok::<_, Infallible>(check.run());
    let Ok(outcomes) = on_all_processors(&checks, "checks", |check| check.id, run);
    checks.into_iter().zip(outcomes).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use twofold_verify::check::{Bound, Kind, Measured};

    const PASSES: Check = Check {
        id: "passes",
        kind: Kind::Exact,
        equations: &[22, 23, 24],
        statement: "zero is zero",
        figure: "mismatches",
        bound: Bound::AtMost(0.0),
        reason: "exact",
        measure: || Ok(Measured::new(0.0, "")),
    };

    #[test]
    fn results_keep_the_order_of_the_list_and_each_failure_is_reported() {
        let nan = Check { id: "nan", measure: || Ok(Measured::new(f64::NAN, "at t = 3")), ..PASSES };
        let panics = Check { id: "panics", measure: || panic!("out of luck"), ..PASSES };
        let errs = Check { id: "errs", measure: || Err("no solution".to_owned()), ..PASSES };
        let results = run_all(vec![PASSES, nan, errs, panics]);
        let ids: Vec<_> = results.iter().map(|(check, _)| check.id).collect();
        assert_eq!(ids, ["passes", "nan", "errs", "panics"]);

        assert!(matches!(conclude(&results), Err(Failure::Failed(m)) if m == "failed checks: nan, errs, panics"));
        assert!(conclude(&results[..1]).is_ok());

        let text = report::tables(&results, 130, true);
        for line in ["FAIL nan: zero is zero", "at t = 3", "no solution", "panicked: out of luck", "22-24"] {
            assert!(text.contains(line), "no `{line}` in\n{text}");
        }
        assert!(text.lines().all(|line| line.chars().count() <= 130), "{text}");
        assert!(report::summary(&results, 1.0).ends_with("3 FAIL"));

        let json: serde_json::Value = serde_json::from_str(&report::json(&results)).expect("JSON");
        assert_eq!(json[0]["passed"], true);
        assert_eq!(json[0]["bound"]["at_most"], 0.0);
        assert!(json[1]["measured"].is_null() && json[1]["detail"] == "at t = 3");
        assert_eq!(json[2]["error"], "no solution");
    }
}
