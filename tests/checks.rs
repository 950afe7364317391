//! Runs every check of the project as a separate test: `cargo test --test checks -- ID`.
//!
//! If the variable `FAIL_FAST` is set, the first failure ends the run, which is sufficient for mutation tests.

use libtest_mimic::{Arguments, Failed, Trial};
use twofold_verify::check::Check;
use twofold_verify::checks::{all, outcome};
use twofold_verify::claims::markdown;

fn main() {
    let of_check = |check: Check| {
        Trial::test(check.id, move || {
            let outcome = outcome(check.id).expect("a check of the list");
            if outcome.passed {
                return Ok(());
            }
            let failure = match &outcome.measured {
                Ok(measured) => format!(
                    "{}\n{}: {:e}, required {} ({})\n{}",
                    check.statement, check.figure, measured.figure, check.bound, check.reason, measured.detail
                ),
                Err(message) => format!("{}\n{message}", check.statement),
            };
            if std::env::var_os("FAIL_FAST").is_some() {
                eprintln!("{}: {failure}", check.id);
                std::process::exit(101);
            }
            Err(Failed::from(failure))
        })
        .with_kind(check.kind.name())
    };
    let mut trials: Vec<_> = all().into_iter().map(of_check).collect();
    // These run last, when most of their figures exist.
    trials.push(Trial::test("page-of-claims", page_of_claims));
    trials.push(Trial::test("figures-of-the-documentation", figures_of_the_documentation));
    libtest_mimic::run(&Arguments::from_args(), trials).exit();
}

/// In tables of `docs/` with a column `figure`, the figure of each check named in the last column is the measured one: to the digits written, or to
/// a factor of two for figures that are rounding and depend on the machine.
fn figures_of_the_documentation() -> Result<(), Failed> {
    let (mut seen, mut stale) = (0, String::new());
    for page in std::fs::read_dir("docs")? {
        let page = page?.path();
        if page.extension().is_none_or(|extension| extension != "md") {
            continue;
        }
        let mut has_figures = false;
        for line in std::fs::read_to_string(&page)?.lines() {
            let line = line.replace("\\|", "");
            let cells: Vec<_> = line.trim_matches('|').split('|').map(str::trim).collect();
            if !line.starts_with('|') || cells.len() < 3 {
                has_figures = false;
                continue;
            }
            has_figures |= cells[1] == "figure";
            let name = cells[cells.len() - 1].trim_matches('`');
            let Some(found) = has_figures.then(|| outcome(name.trim_start_matches("verify --filter "))).flatten()
            else {
                continue;
            };
            let measured = found.measured.as_ref().map_err(|message| format!("{name}: {message}"))?.figure;
            seen += 1;
            if !agrees(cells[1], measured) {
                stale += &format!("\n{}: {name}: `{}`, and it measures {measured:e}", page.display(), cells[1]);
            }
        }
    }
    if seen < 50 || !stale.is_empty() { Err(format!("{seen} figures{stale}").into()) } else { Ok(()) }
}

/// Whether a text begins with a number, in percent or not, that is the rounded measured one.
fn agrees(text: &str, measured: f64) -> bool {
    let length = text.find(|c: char| !(c.is_ascii_digit() || ".e-".contains(c))).unwrap_or(text.len());
    let (number, rest) = text.split_at(length);
    let Ok(written) = number.parse::<f64>() else { return false };
    let unit = if rest.trim_start().starts_with('%') { 0.01 } else { 1.0 };
    let (digits, power) = number.split_once('e').unwrap_or((number, "0"));
    let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len()) as i32;
    let step = 10.0_f64.powi(power.parse::<i32>().expect("an exponent") - decimals);
    let (least, most) = if written * unit < 1e-8 && written > 0.0 {
        (written / 2.0, written * 2.0)
    } else {
        (written - 0.501 * step, written + 0.501 * step)
    };
    (least * unit..=most * unit).contains(&measured)
}

/// `docs/claims.md` is the generated page, and every check of it passes.
fn page_of_claims() -> Result<(), Failed> {
    let page = std::fs::read_to_string("docs/claims.md")?;
    if page == markdown()? { Ok(()) } else { Err("stale: run `cargo run --release -- claims > docs/claims.md`".into()) }
}
