//! `docs/reliability/stability.md` agrees with measured maxima.

use std::fs;

use twofold_verify::stability::cases::FAMILIES;
use twofold_verify::stability::denormal::POINTS;
use twofold_verify::stability::{Case, table};

fn cases() -> Vec<Case> {
    FAMILIES.iter().flat_map(|family| (family.cases)()).collect()
}

#[test]
fn stated_maxima_are_rounded_up() {
    let stated = [0.0, 0.01, 0.5, 2.2, 2.7, 99.6, 101.0, 1.234e5].map(table::stated);
    assert_eq!(stated, ["0.0", "0.5", "0.5", "2.5", "3.0", "100.0", "1.1e2", "1.3e5"]);
}

#[test]
fn maxima_are_at_most_those_stated() {
    let page = fs::read_to_string("docs/reliability/stability.md").expect("the page is there");
    for case in cases() {
        let label = table::label(&case);
        let rows: Vec<&str> = page.lines().filter(|line| line.starts_with(&label)).collect();
        assert_eq!(rows.len(), 1, "one row for {label}: run `cargo run --release -q -- stability`");
        let cells: Vec<&str> = rows[0].split('|').map(str::trim).collect();
        let found = case.measure(1);
        // Another C library may round a sine differently.
        let allowed = |stated: &str| stated.parse::<f64>().expect("a number") + 0.5;
        assert!(found.kernel.ulp <= allowed(cells[3]), "{label}: {} ulp, stated {}", found.kernel.ulp, cells[3]);
        if let Some(errors) = found.derivative {
            let stated = cells[8].split(',').next().expect("a cell");
            assert!(errors.ulp <= allowed(stated), "{label} derivative: {} ulp, stated {stated}", errors.ulp);
        }
    }
}

/// Numbers below the smallest normal one, where 31 digits are not available: see `twofold_verify::stability::denormal`.
#[test]
fn denormal_inputs_give_the_limit() {
    let (mut sweeps, mut whole, mut numbers) = (0, 0, 0);
    for case in cases().iter().filter(|case| case.goes_to_zero()) {
        let found = case.measure_denormal();
        let label = table::label(case);
        assert!(found.without_limit == 0 && found.points >= 4, "{label}: {found:?}");
        whole += usize::from(found.points == POINTS);
        let (ulp, bound) = (found.errors.ulp, case.class.bound());
        assert!(ulp <= bound, "{label}: {ulp} ulp of result {} at {:?}", found.errors.component, found.errors.place);
        sweeps += 1;
        numbers += found.compared;
    }
    assert!(sweeps > 70 && whole > sweeps - 4 && numbers > 12_000, "{sweeps} sweeps, {whole} whole, {numbers} numbers");
}
