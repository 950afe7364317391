//! `twofold bench`.

use super::output_folder::OutputFolder;
use super::progress::Progress;
use super::{Failure, note, print, tell};
use crate::figures;
use clap::Args;
use std::path::PathBuf;
use twofold_bench::table::{self, Results};
use twofold_bench::{Effort, growth, overhead, scaling, work_precision};

#[derive(Args)]
pub(crate) struct BenchArgs {
    /// Take about ten seconds instead of minutes: fewer repeats, and long motions only to 1e4 t_c
    #[arg(long)]
    pub(crate) quick: bool,
    /// Write the tables, every run as CSV and the work-precision plot into this folder
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Replace files that exist
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
}

/// Approximate shares of the time for the sections.
const SHARES: [f64; 4] = [0.55, 0.25, 0.1, 0.1];

pub(super) fn bench(args: &BenchArgs) -> Result<(), Failure> {
    if cfg!(debug_assertions) {
        note("this program was built without optimisation: build it with --release to time it");
    }
    let effort = if args.quick { Effort::QUICK } else { Effort::FULL };
    let folder = args.out.as_ref().map(|path| OutputFolder::at(path, args.force, is_ours)).transpose()?;
    let results = measure(&effort).map_err(Failure::Failed)?;
    let Some(folder) = folder else { return print(&table::text(&results)) };
    tell(&table::text(&results))?;
    let figure = figures::work_precision(&results.work_precision);
    let png = figures::png(&figure.svg).map_err(Failure::Failed)?;
    folder.write("bench.md", table::text(&results).as_bytes())?;
    folder.write("work-precision.csv", table::csv(&results.work_precision).as_bytes())?;
    folder.write("work-precision.svg", figure.svg.as_bytes())?;
    folder.write("work-precision.png", &png)?;
    folder.complete().map(drop)
}

fn is_ours(name: &str) -> bool {
    name == "bench.md" || name.starts_with("work-precision.")
}

fn measure(effort: &Effort) -> Result<Results, String> {
    let mut progress = Progress::new(true);
    let [a, b, c, d] = sections();
    Ok(Results {
        work_precision: work_precision::measure(effort, |part| progress.show(a(part)))?,
        growth: growth::measure(effort, |part| progress.show(b(part)))?,
        overhead: overhead::measure(effort, |part| progress.show(c(part)))?,
        scaling: scaling::measure(effort, |part| progress.show(d(part)))?,
        set_up: scaling::set_up(effort)?,
    })
}

/// The completed fraction of the whole, from those of the sections.
fn sections() -> [impl Fn(f64) -> f64; 4] {
    let mut from = 0.0;
    SHARES.map(|share| {
        let start = from;
        from += share;
        move |part: f64| start + share * part
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_follow_one_another_to_the_end() {
        let mut end = 0.0;
        for (section, share) in sections().iter().zip(SHARES) {
            assert_eq!(section(0.0), end);
            assert!(share > 0.0 && section(0.5) == end + 0.5 * share, "{share}");
            end = section(1.0);
        }
        assert!((end - 1.0).abs() < 1e-15, "{end}");
    }

    #[test]
    fn files_of_an_earlier_run_are_replaced_and_no_others() {
        let names = ["bench.md", "work-precision.csv", "work-precision.svg", "work-precision.png"];
        assert!(names.into_iter().all(is_ours));
        assert!(!["bench.txt", "precision.csv", "my-bench.md"].into_iter().any(is_ours));
    }
}
