//! Common parts of the two figures of spectra: the lines of an observable, their table and their names.

use twofold::dynamics::BodyState;
use twofold::observables::spectrum::{Combination, FundamentalFrequency, SpectralLine};

use super::drawing::*;
use super::number::significant;

/// Weaker lines, relative to the strongest one, are not computed.
const WEAKEST: f64 = 1e-6;

/// The lines of an observable of the state up to the frequency `highest`, strongest first, with frequencies in the unit of the figure; lines
/// below the `error` of the observable do not count.
pub(super) fn spectrum(
    subject: &Subject,
    highest: f64,
    error: f64,
    observable: impl Fn(&BodyState<f64>) -> f64,
) -> Result<Vec<SpectralLine>, String> {
    let function = |state: &BodyState<f64>| Ok::<_, twofold::Error>([observable(state), error / ALIKE]);
    let list = subject.quasi_periodic()?.lines(WEAKEST, function);
    let list = list.map_err(|why| format!("{}: {why}", subject.name))?;
    let drawn = |line: SpectralLine| SpectralLine { frequency: subject.scale.frequency(line.frequency), ..line };
    let lines = list.lines.into_iter().filter(|line| line.amplitude > error).map(drawn);
    Ok(lines.filter(|line| line.frequency <= highest).collect())
}

/// Draws lines as vertical lines from the lower edge of a panel.
pub(super) fn draw_lines(page: &mut Page, panel: &Panel, lines: &[SpectralLine], bottom: f64, line: Line) {
    for found in lines.iter().filter(|found| found.amplitude > bottom) {
        panel.curve(page, &[(found.frequency, bottom), (found.frequency, found.amplitude)], line);
    }
}

/// The name of a line with markup: `*α* − *l*`.
pub(super) fn name(combination: &Combination) -> String {
    let mut name = combination.to_string().replace(" - ", " \u{2212} ");
    if let Some(rest) = name.strip_prefix('-') {
        name = format!("\u{2212}{rest}");
    }
    let symbols = [
        ("alpha'", "*α*"),
        ("gamma'", "*γ*"),
        ("nu'", "*ν*"),
        ("psi'", "*ψ*"),
        ("theta_1'", "*θ*_{1}"),
        ("theta_2'", "*θ*_{2}"),
        ("theta_3'", "*θ*_{3}"),
        ("l'", "*l*"),
    ];
    symbols.iter().fold(name, |name, (plain, symbol)| name.replace(plain, symbol))
}

/// Meanings of the symbols of mean rates in some names.
pub(super) fn symbols_in(names: &[String]) -> String {
    let meanings = [
        ("*α*", "of the precession angle"),
        ("*γ*", "of the rotation angle"),
        ("*l*", "of the slow precession"),
        ("*ν*", "of nutation"),
        ("*ψ*", "of the rotation about the symmetry axis"),
        ("*θ*", "of the angles of the torus"),
    ];
    let named = meanings.iter().filter(|(symbol, _)| names.iter().any(|name| name.contains(symbol)));
    named.map(|(symbol, meaning)| format!("{symbol} {meaning}")).collect::<Vec<_>>().join(", ")
}

/// Lines as a table: frequency, amplitude, and the multiple of each fundamental frequency.
pub(super) fn lines_table(name: String, lines: &[SpectralLine], frequency: String, unit: &str) -> Table {
    const SYMBOLS: [&str; 5] = ["alpha'", "gamma'", "l'", "nu'", "psi'"];
    let multiples = SYMBOLS.map(|symbol| format!("multiple of {symbol} [1]"));
    let head = [frequency, format!("amplitude [{unit}]")];
    let mut table = Table::new(name, head.into_iter().chain(multiples));
    for line in lines {
        let mut row = vec![line.frequency, line.amplitude];
        row.extend(SYMBOLS.iter().map(|symbol| f64::from(line.combination.multiple(symbol))));
        table.push(row);
    }
    table
}

pub(super) fn sentence(clauses: &str) -> String {
    let mut letters = clauses.chars();
    letters.next().map_or(String::new(), |first| format!("{}{}.", first.to_uppercase(), letters.as_str()))
}

/// Words for captions: unit of frequencies, mean rates, and the motion that has the lines.
pub(super) fn of_rates(subjects: &[&Subject]) -> Result<[(&'static str, String); 3], String> {
    let motion = match subjects[0].kind() {
        "averaged" => "averaged motion",
        _ => "exact motion, from a Fourier series on its torus",
    };
    let rates = subjects.iter().map(|subject| rates(subject)).collect::<Result<Vec<_>, _>>()?.join("; ");
    Ok([("unit", subjects[0].scale.frequency_unit().to_owned()), ("rates", rates), ("motion", motion.to_owned())])
}

fn rates(subject: &Subject) -> Result<String, String> {
    let frequencies = subject.quasi_periodic()?.frequencies();
    let is_told = |of: &&FundamentalFrequency| of.rate != 0.0 && of.symbol != "psi'";
    let mut told: Vec<_> = frequencies.all.iter().filter(is_told).collect();
    if told.is_empty() {
        told.extend(frequencies.basis.iter().filter(is_told));
    }
    let in_words = |of: &FundamentalFrequency| {
        let name = name(&Combination { terms: vec![(1, of.symbol)] });
        format!("{name} = {}", significant(subject.scale.frequency(of.rate), 7))
    };
    let told: Vec<_> = told.into_iter().map(in_words).collect();
    Ok(format!("{}: {}", subject.name, told.join(", ")))
}

/// The highest frequency in a figure, in its unit: a multiple of the rate of rotation, rounded up to half of its first digit.
pub(super) fn highest(subjects: &[&Subject], times: f64) -> f64 {
    let rate = |subject: &&Subject| subject.scale.frequency(subject.rotation_rate);
    let highest = times * subjects.iter().map(rate).fold(0.0, f64::max);
    rounded_up(highest)
}

/// Rounds up to half of the first digit.
fn rounded_up(x: f64) -> f64 {
    let half = 10f64.powf(x.log10().floor()) / 2.0;
    (x / half).ceil() * half
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::fixtures::{CONSTANTS, star, tone};

    #[test]
    fn the_end_of_an_axis_is_half_a_digit_up_at_most() {
        for (x, end) in [(3.2, 3.5), (3.5, 3.5), (3.6, 4.0), (97.0, 100.0), (1.1, 1.5), (0.041, 0.045), (2.3e5, 2.5e5)]
        {
            assert!((rounded_up(x) / end - 1.0).abs() < 1e-12, "{x}: {}", rounded_up(x));
        }
    }

    #[test]
    fn a_line_that_begins_with_a_minus_has_its_sign() {
        let names = [vec![(-2, "alpha'"), (1, "gamma'")], vec![(1, "nu'"), (-1, "psi'")], vec![(-1, "l'")]]
            .map(|terms| name(&Combination { terms }));
        assert_eq!(names, ["\u{2212}2 *α* + *γ*", "*ν* \u{2212} *ψ*", "\u{2212}*l*"]);
    }

    /// For free precession about Z, `alpha'` is `1.1 / cos 0.7`, equal to `|L| / I^xx` and `nu'`, and `gamma'` is `-0.1`, all times the spin. There
    /// is no slow rate.
    #[test]
    fn rates_of_free_precession_are_those_of_eq_48() {
        let [slow, fast] = [0.01, 1.0].map(|spin| star("a", spin, [0.0; 3], CONSTANTS));
        let [unit, rates, _] = of_rates(&[&slow, &fast]).unwrap();
        assert_eq!(unit, ("unit", "rad/*t*_{c}".to_owned()));
        let told = "a: *α* = 0.01438205, *γ* = \u{2212}0.001, *ν* = 0.01438205; a: *α* = 1.438205, *γ* = \u{2212}0.1, *ν* = 1.438205";
        assert_eq!(rates, ("rates", told.to_owned()));
        // The rates are 0.0316 and 3.16.
        for (subjects, end) in [(vec![&slow], 0.035), (vec![&slow, &fast], 3.5), (vec![&fast, &slow], 3.5)] {
            assert!((highest(&subjects, 2.2) / end - 1.0).abs() < 1e-12, "{end}");
        }
    }

    /// 57 Hz times `1.001 / cos 0.3` and `-0.001`.
    #[test]
    fn rates_of_a_physical_star_are_in_hertz() {
        let [unit, (_, rates), _] = of_rates(&[&tone(1.0, 1.0)]).unwrap();
        assert_eq!(unit.1, "Hz");
        assert_eq!(rates, "tone: *α* = 59.72451, *γ* = \u{2212}0.057, *ν* = 59.72451");
    }
}
