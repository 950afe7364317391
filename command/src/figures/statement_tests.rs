//! The statements of captions hold in the tables beside them.

use std::f64::consts::TAU;

use nalgebra::Vector3;
use twofold_verify::paper_examples::COEFFICIENTS;

use super::caption_tests::{assert_told, extremes, table};
use super::data_tests::column;
use super::examples;
use super::fixtures::figure;
use super::momentum_sphere;

fn assert_says(figure_name: &str, words: &str) {
    let says = format!("{} {}", figure(figure_name).caption.says, figure(figure_name).caption.method);
    assert!(says.contains(words), "`{words}` is not in the caption of {figure_name}: {says}");
}

/// Names of the two strongest lines, the amplitude of a weak one, and the slowest line.
#[test]
fn the_spectra_of_the_beam_have_the_lines_that_are_named() {
    let lines = |name: &str| table("beam-alignment-spectra", &format!("{name}-lines"));
    // Multiples of alpha', gamma' and l'.
    let multiples = |row: &[f64]| [row[2], row[3], row[4]];
    for name in ["tp-I", "tp-II"] {
        let rows = &lines(name).rows;
        assert_says("beam-alignment-spectra", &format!("strongest lines of {name} are *α* and *α* + *γ*"));
        assert!(rows.is_sorted_by(|a, b| a[1] >= b[1]));
        assert_eq!([multiples(&rows[0]), multiples(&rows[1])], [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]);
    }
    let slow = |name: &str| lines(name).rows.iter().find(|row| multiples(row) == [0.0, 0.0, -1.0]).expect("a line");
    assert_says(
        "beam-alignment-spectra",
        "*l* of tp-II is at the rate at which its angular momentum goes round *Z*, the slowest of its mean rates",
    );
    let line = |wanted: [f64; 3]| lines("tp-II").rows.iter().find(|row| multiples(row) == wanted).expect("a line")[0];
    assert!(slow("tp-II")[0] < line([1.0, 0.0, 0.0]).min(line([0.0, -1.0, 0.0])));
    let near_its_line = |row: &&Vec<f64>| (row[0] / slow("tp-II")[0] - 1.0).abs() < 0.1;
    let strongest = lines("tp-II").rows.iter().find(near_its_line).expect("a line");
    assert_eq!(multiples(strongest), [0.0, 0.0, -1.0]);
    assert_says("beam-alignment-spectra", "tp-I has it too, but some 640 times weaker");
    assert!((lines("tp-I").rows[0][1] / slow("tp-I")[1] / 640.0 - 1.0).abs() < 0.02);
}

/// The rates in a caption are the frequencies of lines of `m.n`.
#[test]
fn mean_rates_in_captions_are_frequencies_of_lines() {
    for figure_name in ["beam-alignment-spectra", "wave-spectra"] {
        let (_, rates) = figure(figure_name).caption.method.split_once("Mean rates in ").expect("rates");
        for name in ["tp-I", "tp-II"] {
            let lines = table("beam-alignment-spectra", &format!("{name}-lines"));
            let line = |multiples: [f64; 3]| {
                let found = lines.rows.iter().find(|row| row[2..5] == multiples).expect("a line");
                found[0]
            };
            let [alpha, gamma, slow] = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]].map(line);
            let (_, rates) = rates.split_once(&format!("{name}: ")).expect("the star");
            // The body turns backwards about its axis, L about Z.
            let told = [("*α* = ", ", ", alpha, 7), ("*γ* = ", ", ", -gamma, 7), ("*l* = ", ", ", -slow, 7)];
            assert_told(rates, &told);
        }
    }
}

#[test]
fn powers_of_lines_are_those_of_the_lists() {
    let mut expected = Vec::new();
    let says = &figure("line-atlas").caption.says;
    for name in ["m.n", "h_plus", "h_cross"] {
        let lacking = table("line-atlas", &format!("{name}-lines")).rows.iter().filter(|row| row[3] == 2.0);
        expected.extend(lacking.map(|row| format!("{:.2}", row[4])));
    }
    let (_, powers) = says.split_once("powers of *s*: ").expect("powers");
    let (powers, _) = powers.split_once(". The waves").expect("an end");
    let told: Vec<_> = powers.split([',', ';']).filter_map(|line| line.rsplit(' ').next()).collect();
    assert_eq!(told, expected);
}

/// The mean torque, as `P_2(cos w)`, vanishes at the wobble `w` = 54.7 deg.
#[test]
fn waves_at_multiples_of_the_slow_rate_vanish_where_the_mean_torque_does() {
    let zero = (1.0_f64 / 3.0).sqrt().acos();
    assert_says("line-atlas", "a wobble of about 0.96 rad (54.7°)");
    assert!((zero - 0.96).abs() < 0.005 && (zero.to_degrees() - 54.7).abs() < 0.05);
    for name in ["h_plus-wobble", "h_cross-wobble"] {
        let table = table("line-atlas", name);
        let place = table.columns.iter().position(|head| head.starts_with("2 l' [")).expect("a line");
        let later: Vec<_> = table.rows.iter().filter(|row| row[0] > 0.5).collect();
        let least = later.iter().min_by(|a, b| a[place].total_cmp(&b[place])).expect("a row");
        let next = later.iter().map(|row| (row[0] - zero).abs()).fold(f64::INFINITY, f64::min);
        assert_eq!((least[0] - zero).abs(), next, "{name}: least at {}", least[0]);
        assert!(least[place] < 0.01 * later[0][place], "{name}: {least:?}");
    }
}

/// The row of a map nearest to an inclination and a second parameter.
fn error(name: &str, beta_0: f64, parameter: f64) -> &'static [f64] {
    let off = |row: &&Vec<f64>| (row[0] - beta_0).abs() + (row[1] / parameter).ln().abs();
    let rows = table("perturbation-regimes", name).rows.iter();
    rows.min_by(|a, b| off(a).total_cmp(&off(b))).expect("a row")
}

/// The exponent of an error as a function of the second parameter, from one row of the map to a later one.
fn power(name: &str, beta_0: f64, parameters: [f64; 2]) -> f64 {
    let [a, b] = parameters.map(|parameter| error(name, beta_0, parameter));
    (b[2] / a[2]).ln() / (b[1] / a[1]).ln()
}

/// If the error is above eight times the remainder at the smallest `A`, this remainder changes an exponent measured over a factor of three by at
/// most `ln(9/8) / ln 3`, 0.11; the next order changes it about as much.
#[test]
fn errors_of_twofold_precession_grow_as_the_caption_says() {
    assert_says("perturbation-regimes", "Up to an *A* of 0.03 the error of the printed twofold solution grows as *A*,");
    assert_says(
        "perturbation-regimes",
        "up to 0.3 that of the corrected one as the square of *A*, each from where it is above",
    );
    let cases = [("twofold-printed", 1.0, [1e-3, 3e-3, 1e-2]), ("twofold-corrected", 2.0, [1e-2, 3e-2, 1e-1])];
    for (name, expected, amplitudes) in cases {
        let mut compared = 0;
        for beta_0 in [0.35, 0.5, 0.65, 0.8, 0.95, 1.1, 1.25, 1.4] {
            let rest = error(name, beta_0, 1e-4)[2];
            for from in amplitudes.into_iter().filter(|from| error(name, beta_0, *from)[2] > 8.0 * rest) {
                let found = power(name, beta_0, [from, 3.0 * from]);
                assert!((found - expected).abs() < 0.25, "{name} {beta_0} {from}: {found}");
                compared += 1;
            }
        }
        assert!(compared >= 16, "{name}: {compared}");
    }
    assert_says(
        "perturbation-regimes",
        "some 10^{−4} for inclinations up to 0.8; of the corrected solution it vanishes towards",
    );
    for beta_0 in [0.2, 0.35, 0.5, 0.65, 0.8] {
        let least = ["twofold-printed", "twofold-corrected"].map(|name| error(name, beta_0, 1e-4)[2]);
        assert!(least.iter().all(|least| (1e-4..4e-4).contains(least)), "{beta_0}: {least:?}");
    }
    assert!(error("twofold-corrected", 1.5, 1e-4)[2] < 1e-7);
}

#[test]
fn errors_of_single_precession_grow_as_the_caption_says() {
    assert_says("perturbation-regimes", "corrected single solution grows as the square of the asymmetry");
    for beta_0 in [0.35, 0.7, 1.0, 1.1] {
        let found = power("single-corrected", beta_0, [0.015, 0.05]);
        assert!((found - 2.0).abs() < 0.15, "{beta_0}: {found}");
    }
    assert_says("perturbation-regimes", "half of the asymmetry at *β*_{0} = 1 and less at smaller inclinations");
    let further = |beta_0: f64, asymmetry: f64| {
        let [printed, corrected] = ["single-printed", "single-corrected"].map(|name| error(name, beta_0, asymmetry));
        [(printed[2] - corrected[2]) / printed[1], printed[2] / corrected[2]]
    };
    for asymmetry in [0.01, 0.02, 0.03, 0.05] {
        let [share, ratio] = further(1.0, asymmetry);
        assert!((share - 0.5).abs() < 0.08 && ratio > 2.0, "{asymmetry}: {share} {ratio}");
        let shares = [0.2, 0.5, 0.7, 0.9].map(|beta_0| further(beta_0, asymmetry)[0]);
        assert!(shares.is_sorted() && shares[3] < share && shares[0] < 0.1 * share, "{asymmetry}: {shares:?} {share}");
    }
    assert_says("perturbation-regimes", "At the asymmetry of sp-I the correction takes a quarter off an error of 0.03");
    let [printed, corrected] = ["single-printed", "single-corrected"].map(|name| error(name, 0.7, 1.0 / 11.0)[2]);
    assert!((printed - 0.03).abs() < 0.002 && (corrected / printed - 0.75).abs() < 0.02, "{printed} {corrected}");
}

/// Columns: `x`, `t`, the averaged motion of second and first order, the corrected and the printed perturbation solution.
#[test]
fn errors_of_methods_grow_as_the_caption_says() {
    let rows = |name: &str| table("method-regimes", name).rows.iter();
    assert_says(
        "method-regimes",
        "the printed twofold solution is off by 0.01*x* soon, and like the corrected one by 2*x*^{2}*t*/*t*_{c} in the long run",
    );
    for row in rows("near-axis").filter(|row| row[1] > 8.0) {
        let [x, t, _, _, corrected, printed, ..] = row[..] else { panic!("{row:?}") };
        let long_run = 2.0 * x * x * t;
        assert!((corrected / long_run - 0.9).abs() < 0.15 || long_run > 0.1, "{row:?}");
        // If one of the two dominates.
        if long_run < 1e-3 * x {
            assert!((printed / (0.01 * x) - 1.0).abs() < 0.1, "{row:?}");
        } else if long_run > 0.1 * x {
            assert!((printed / corrected - 1.0).abs() < 0.1, "{row:?}");
        }
    }
    assert_says("method-regimes", "where *L* is tilted, by *A* = 0.4, neither is of use");
    assert!(rows("tilted").all(|row| row[4].min(row[5]) > 0.09));
    assert_says(
        "method-regimes",
        "from 10 *t*_{c} until its error is 0.002, the printed single solution drifts by 0.03*xt*/*t*_{c}",
    );
    assert_says("method-regimes", "the corrected one by 0.0015 to 0.004 of *xt*/*t*_{c}");
    let (mut of_printed, mut of_corrected) = (Vec::new(), Vec::new());
    for row in rows("single").filter(|row| row[0] < 1.01e-3 && row[1] > 9.9) {
        let drift = |error: f64| (error <= 2e-3).then_some(error / (row[0] * row[1]));
        of_corrected.extend(drift(row[4]));
        of_printed.extend(drift(row[5]));
    }
    for (drifts, [low, high]) in [(of_printed, [0.025, 0.036]), (of_corrected, [0.0014, 0.0041])] {
        let outside: Vec<_> = drifts.iter().filter(|drift| **drift < low || **drift > high).collect();
        assert!(outside.is_empty() && drifts.len() > 40, "{outside:?} of {}", drifts.len());
    }
}

/// `2 pi / gamma'` of both, `2 pi / l'` of tp-II, and the phase errors from the rates of Eq. (57) after 400 t_c.
#[test]
fn pulses_are_modulated_with_the_periods_that_are_told() {
    assert_says("pulse-series", "modulated with the period of *γ*, about 40 *t*_{c}");
    assert_says("pulse-series", "a second modulation of about 180 *t*_{c}");
    assert_says("pulse-series", "rates of Eq. (57) are off by a radian of *γ* in 400 *t*_{c}");
    let [first, second, ..] = examples().expect("motions");
    let rate = |subject: &super::Subject, symbol: &str| {
        subject.quasi_periodic().expect("a torus").frequencies().rate(symbol).expect("a rate")
    };
    for subject in [&first, &second] {
        let period = TAU / rate(subject, "gamma'").abs();
        assert!((period / 40.0 - 1.0).abs() < 0.1, "{}: {period}", subject.name);
    }
    let slow = TAU / rate(&second, "l'").abs();
    assert!((slow / 180.0 - 1.0).abs() < 0.03, "{slow}");
    let printed = first.printed.expect("constants");
    let by_57 = first.spin() - printed.rate * printed.constants.beta_0.cos();
    let off = 400.0 * (rate(&first, "gamma'") - by_57).abs();
    assert!((off - 1.0).abs() < 0.3, "{off} rad");
}

/// `l.(s l)` is the level on a contour, the middle eigenvalue on the separatrix and nearly so on the path of sp-II; the path of the star near Y
/// closes.
#[test]
fn paths_of_the_momentum_follow_contours() {
    let s = COEFFICIENTS.tensor();
    let form = |l: &Vector3<f64>| {
        assert!((l.norm() - 1.0).abs() < 1e-14);
        l.dot(&(s * l))
    };
    for level in momentum_sphere::LEVELS {
        let [front, back] = momentum_sphere::contour(level);
        assert!(front.iter().zip(&back).all(|(a, b)| (a - b).norm() > 0.1 && (form(a) - level).abs() < 1e-15));
        assert!(back.iter().all(|l| (form(l) - level).abs() < 1e-15));
    }
    for circle in momentum_sphere::separatrix() {
        assert!(circle.iter().all(|l| (form(l) - COEFFICIENTS.yy).abs() < 1e-15));
        assert!(circle.iter().any(|l| l.y > 0.999) && circle.iter().any(|l| l.y < -0.999));
    }
    let table = table("momentum-sphere", "");
    let along = |name: &str| extremes(table, column(table, &format!("l.(s l) of {name} [1]")));
    let spread = COEFFICIENTS.xx - COEFFICIENTS.zz;
    for name in ["tp-I", "tp-II", "sp-I", "sp-II", "near Y"] {
        let [low, high] = along(name);
        assert!(high - low < 0.1 * spread, "{name}: off its contour by {}", high - low);
    }
    assert_says("momentum-sphere", "sp-II runs close to the separatrix");
    let off = |name: &str| {
        let [low, high] = along(name);
        (0.5 * (low + high) - COEFFICIENTS.yy).abs() / spread
    };
    assert!(off("sp-II") < 0.06 && off("sp-II") < 0.3 * off("sp-I").min(off("tp-I")), "{}", off("sp-II"));
    assert_says(
        "momentum-sphere",
        "a star that starts near *Y* leaves it along the separatrix, goes round, and comes back",
    );
    let y = column(table, "l_Y of near Y [1]");
    let cosines: Vec<_> = table.rows.iter().map(|row| row[y]).collect();
    let left = cosines.iter().position(|y| *y < -0.99).expect("it goes to the other side");
    assert!(cosines[0] > 0.998 && cosines[left..].iter().any(|y| *y > 0.998));
}
