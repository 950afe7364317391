//! The paper's numbers with ours, as snapshots for review in `golden/`, and their digits compared with rigorous enclosures.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use twofold_command::figures::{all, golden_tables};
use twofold_verify::claims::claims;
use twofold_verify::equation_table::EQUATIONS;
use twofold_verify::golden::{Certainty, Enclosures, GoldenTable};

static TABLES: LazyLock<Vec<GoldenTable>> =
    LazyLock::new(|| all().and_then(|figures| golden_tables(&figures)).expect("the golden numbers can be computed"));

fn names() -> BTreeSet<&'static str> {
    TABLES.iter().map(|table| table.name).collect()
}

#[test]
fn golden_tables_are_as_reviewed() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../../golden");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        for table in &*TABLES {
            insta::assert_snapshot!(table.name, table.to_string());
        }
    });
}

/// Every number is certified or listed; `docs/reliability/certified.md` states the counts.
#[test]
fn digits_are_certified_or_listed_with_a_reason() {
    let file = |name| std::fs::read_to_string(format!("../{name}")).expect("the file is there");
    let texts =
        ["verify/data/certified.csv", "verify/data/not_enclosed.csv", "docs/reliability/certified.md"].map(file);
    let enclosures = Enclosures::parse(&texts[0], &texts[1]).expect("the enclosures are readable");
    let (mut certified, mut listed, mut wrong) = (0, 0, Vec::new());
    for table in &*TABLES {
        for line in &table.lines {
            match enclosures.certainty(table, line) {
                Certainty::Certified => certified += 1,
                Certainty::NotEnclosed(_) => listed += 1,
                Certainty::Wrong(how) => wrong.push(format!("{}: {}: {how}", table.name, line.label)),
            }
        }
    }
    assert!(wrong.is_empty(), "{} numbers:\n{}", wrong.len(), wrong.join("\n"));
    let superfluous = enclosures.superfluous(&*TABLES);
    assert!(
        superfluous.is_empty(),
        "lines of not_enclosed.csv are the reason of no number:\n{}",
        superfluous.join("\n")
    );
    assert_eq!(certified, enclosures.count(), "there are enclosures of numbers that no golden table has");
    let counts = format!("| all | {certified} | {listed} |");
    assert!(texts[2].contains(&counts), "docs/reliability/certified.md has no line {counts}");
    let share = format!("{certified} of {}", certified + listed);
    for page in ["docs/reliability/certified.md", "docs/reliability.md"] {
        assert!(file(page).contains(&share), "{page} does not say that {share} golden numbers are certified");
    }
}

#[test]
fn the_equations_name_every_table_and_no_other() {
    let named: BTreeSet<_> = EQUATIONS.iter().flat_map(|equation| equation.golden).copied().collect();
    assert_eq!(named, names(), "golden tables named by the equations, and those that exist");
}

#[test]
fn the_claims_name_tables_that_exist() {
    for claim in claims() {
        for name in claim.golden {
            assert!(names().contains(name), "{} names the golden table {name}, which does not exist", claim.id);
        }
    }
}
