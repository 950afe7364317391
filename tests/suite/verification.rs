//! Foundations of the checks: bounds, double-double numbers, printed digits, enclosures.

use num_traits::One;
use twofold::dynamics::{BodyState, Problem, RigidSpheroid, RotationState};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::propagation::Motion;
use twofold::{Real, Scalar};
use twofold_verify::check::{Bound, Check, Kind, Measured, Outcome, Worst, largest, largest_component, smallest};
use twofold_verify::double_double::DoubleDouble;
use twofold_verify::golden::{GoldenLine, Printed, rounds_to};
use twofold_verify::pulse_series::Viewing;
use twofold_verify::report;

#[test]
fn what_is_not_a_number_is_not_small() {
    assert_eq!(largest([1.0, 3.0, 2.0]), 3.0);
    for figures in [[f64::NAN, 1.0], [1.0, f64::NAN]] {
        assert!(largest(figures).is_nan() && !Bound::AtMost(9.0).holds(largest(figures)));
        assert!(smallest(figures).is_nan() && !Bound::AtLeast(0.0).holds(smallest(figures)));
    }
    assert!(largest_component(&nalgebra::Vector3::new(1.0, f64::NAN, 2.0)).is_nan());
}

/// Both ends of an interval count, and a case that gives no number is the worst of all.
#[test]
fn a_figure_is_compared_with_all_of_its_bound() {
    let order = Bound::Within(1.9, 2.1);
    assert_eq!(
        [1.8, 1.9, 2.0, 2.1, 2.2, f64::NAN].map(|figure| order.holds(figure)),
        [false, true, true, true, false, false]
    );
    for figures in [[0.5, f64::NAN, 2.0], [f64::NAN, 0.5, 2.0]] {
        let mut worst = Worst::default();
        figures.iter().for_each(|figure| worst.see(*figure, || format!("at {figure}")));
        let found = worst.finish().expect("three cases");
        assert!(found.figure == f64::INFINITY && found.detail == "worst of 3: at NaN", "{found:?}");
    }
    assert!(Worst::default().finish().is_err());
}

/// Small figures keep their digits, and only equations in a row are written as a run.
#[test]
fn tables_show_what_was_measured() {
    let outcome = |figure| Outcome { measured: Ok(Measured::new(figure, "")), passed: true, seconds: 0.0 };
    let shown = [0.0, 3.25e-13, -3.25e-13, 0.012_34, 1234.5].map(|figure| report::measured(&outcome(figure)));
    assert_eq!(shown, ["0", "3.250e-13", "-3.250e-13", "0.0123", "1234.5000"]);
    let check = Check {
        id: "of-five",
        kind: Kind::Oracle,
        equations: &[21, 25, 26, 27, 36],
        statement: "Five equations",
        figure: "error",
        bound: Bound::AtMost(1.0),
        reason: "none",
        measure: || Err("not run".to_owned()),
    };
    let table = report::tables(&[(check, outcome(0.5))], 200, false);
    // Each on a line of a narrow column.
    assert!(["21, ", " 25-27,", " 36"].iter().all(|part| table.contains(part)), "{table}");
}

/// Unit of the last place, 2^-105.
const EPSILON: f64 = 2.5e-32;

fn number(text: &str) -> DoubleDouble {
    text.parse().expect("a decimal number")
}

fn close(a: DoubleDouble, b: DoubleDouble) {
    let difference = ((a - b) / b).high().abs();
    assert!(difference <= 4.0 * EPSILON, "{a:?} and {b:?} differ by {difference:e}");
}

#[test]
fn decimals_are_read_to_the_last_digit() {
    assert_eq!(number("-12.5"), DoubleDouble::from_f64(-12.5));
    assert_eq!(number("3e2"), DoubleDouble::from_f64(300.0));
    let third = DoubleDouble::one() / DoubleDouble::from_f64(3.0);
    close(number("0.33333333333333333333333333333333333"), third);
    assert_eq!(number("0.1").high(), 0.1);
    assert!(["", "-", "1.2.3", "x", "1e"].iter().all(|text| text.parse::<DoubleDouble>().is_err()));
}

#[test]
fn functions_have_thirty_digits() {
    let two = DoubleDouble::from_f64(2.0);
    let one = DoubleDouble::one();
    close(two.sqrt(), number("1.4142135623730950488016887242096980786"));
    close(one.exp(), number("2.7182818284590452353602874713526624978"));
    close(two.ln(), number("0.69314718055994530941723212145817656808"));
    let (sin, cos) = number("0.7").sin_cos();
    close(sin, number("0.64421768723769105367261435139872018307"));
    close(cos, number("0.76484218728448842625585999019186490927"));
    // mpmath, 60 digits.
    let (sin, cos) = number("1e15").sin_cos();
    close(sin, number("0.858272793170235835523886390848406647"));
    close(cos, number("-0.51319373778697025223453613642316493"));
    let quarter = number("0.78539816339744830961566084581987572104");
    close(one.atan2(one), quarter);
    close(one.atan2(-one), quarter * 3.0);
    close((-one).atan2(-one), -quarter * 3.0);
}

#[test]
fn a_motion_agrees_with_the_reference_beyond_double_precision() {
    let spheroid = RigidSpheroid::in_units_of_tc(number("1.1"));
    let s = PrincipalCoefficients::new(["0.02", "0.01", "-0.04"].map(number)).tensor();
    let rows =
        include_str!("../../verify/data/reference_states.csv").lines().filter_map(|line| line.strip_prefix("tp-2,"));
    let states: Vec<Vec<DoubleDouble>> = rows.map(|row| row.split(',').map(number).collect()).collect();
    let vector = |i: usize| nalgebra::Vector3::from_column_slice(&states[0][i..i + 3]);
    let problem = Problem::new(spheroid, s, BodyState::from_vectors([1, 4, 7].map(vector))).expect("a problem");
    let last = states.last().expect("states")[0].high();
    let motion = problem.taylor((0.0, last), 1e-16).expect("a motion");
    for row in &states[1..] {
        let state = motion.state(row[0]).expect("a time of the span");
        let found = state.vectors();
        let error = largest(found.iter().flatten().zip(&row[1..]).map(|(ours, theirs)| (*ours - *theirs).high().abs()));
        // The initial values are rounded to 22 digits, and a phase of 600 rad increases that error.
        assert!(error < 1e-18, "t = {}: {error:e}", row[0].high());
    }
}

#[test]
fn an_enclosure_beside_the_printed_digits_is_seen() {
    assert!(rounds_to("7.00993479e-1", 0.700_993_478_6, 0.700_993_479_4));
    assert!(!rounds_to("7.00993479e-1", 0.700_993_478_4, 0.700_993_479_4));
    assert!(!rounds_to("7.00993479e-1", 0.700_993_478_6, 0.700_993_479_6));
    assert!(!rounds_to("-1e-3", f64::NAN, 1.0) && !rounds_to("1e-3", 1e-3, f64::NAN));
    assert!(!rounds_to("5.14e-4", 5.145e-4, 5.145e-4));
    assert!(rounds_to("0", -1e-50, 1e-50) && !rounds_to("0", -1e-50, 1e-14) && !rounds_to("NaN", 0.0, 0.0));
}

#[test]
fn a_printed_number_is_met_by_what_rounds_to_it() {
    for (ours, printed, verdict) in [
        (0.70099, Printed::Decimal("0.701"), "confirmed"),
        (0.70151, Printed::Decimal("0.701"), "differs"),
        (1.8e-5, Printed::Order("1e-5"), "confirmed"),
        (4e-5, Printed::Order("1e-5"), "differs"),
        (-0.0084, Printed::Decimal("-0.008"), "confirmed"),
        (2.07e-3, Printed::Decimal("2.1e-3"), "confirmed"),
        (2.16e-3, Printed::Decimal("2.1e-3"), "differs"),
    ] {
        assert_eq!(GoldenLine::new("x", printed, ours).verdict(), verdict, "{ours} for {printed:?}");
    }
}

/// The magnetic axis is at the angle `gamma + delta` from the line of nodes: only that sum matters.
#[test]
fn the_azimuth_of_the_magnetic_axis_in_the_body_adds_to_gamma() {
    let viewing = |delta: f64| Viewing { chi: 0.5, delta, rho: 0.9, theta_o: 0.8 };
    let with = viewing(0.7).formulas([0.6, 1.1], [1.4, -0.2]).expect("formulas");
    let without = viewing(0.0).formulas([0.6, 1.8], [1.4, -0.2]).expect("formulas");
    for (a, b) in [
        (with.offset_rate, without.offset_rate),
        (with.azimuth_rate, without.azimuth_rate),
        (with.width, without.width),
    ] {
        assert!((a - b).abs() < 1e-14 && a != 0.0, "{a} {b}");
    }
}
