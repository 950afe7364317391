//! What the two figures of spectra share: a long motion, its fundamental frequencies and the lines of a series.

use std::f64::consts::TAU;

use twofold::dynamics::BodyState;
use twofold::observables::fundamental_frequencies::{FundamentalFrequencies, fundamental_frequencies};
use twofold::observables::spectrum::{Combination, Series, Window, amplitude_spectrum, spectral_lines};
use twofold::propagation::TaylorMotion;

use super::number::{number, significant};
use super::subject::{Subject, TOLERANCE};
use super::table::Table;

/// Values in a series, of which 10 or more are on each wave that matters.
const SAMPLES: usize = 49_152;

/// The taper: narrow enough to part the lines of tp-II, with sidelobes below 1e-5 of a line.
pub(super) const WINDOW: Window = Window::Kaiser { shape: 14.0 };

/// Lines weaker than this, relative to the strongest, are not looked for.
const WEAKEST: f64 = 1e-5;

/// Most lines that are fitted: the errors of all count the strongest one that is left out.
const MOST_FITTED: usize = 200;

const MOST_LINES: usize = 40;

/// A motion long enough to part its frequencies.
#[derive(Debug, Clone)]
pub(super) struct LongMotion {
    motion: TaylorMotion<f64>,
    /// None where the motion has no mean rates that its length shows.
    pub(super) frequencies: Option<FundamentalFrequencies>,
}

impl LongMotion {
    /// The motion of `duration` (t_c) from the start of a subject.
    pub(super) fn of(subject: &Subject, duration: f64) -> Result<Self, String> {
        let motion = subject.problem.taylor((0.0, duration), TOLERANCE);
        let motion = motion.map_err(|error| format!("{}: {error}", subject.name))?;
        let frequencies = fundamental_frequencies(&motion).ok();
        Ok(Self { motion, frequencies })
    }
}

pub(super) struct NamedLine {
    pub(super) frequency: f64,
    pub(super) amplitude: f64,
    pub(super) combination: Option<Combination>,
}

impl NamedLine {
    /// The combination of mean rates, with markup: `*α* − *l*`.
    pub(super) fn name(&self) -> Option<String> {
        let mut name = self.combination.as_ref()?.to_string().replace(" - ", " \u{2212} ");
        if let Some(rest) = name.strip_prefix('-') {
            name = format!("\u{2212}{rest}");
        }
        let symbols = [("alpha'", "*α*"), ("gamma'", "*γ*"), ("nu'", "*ν*"), ("psi'", "*ψ*"), ("l'", "*l*")];
        Some(symbols.iter().fold(name, |name, (plain, symbol)| name.replace(plain, symbol)))
    }
}

/// Amplitudes up to a frequency, and the lines of a series. Frequencies are in the unit drawn.
pub(super) struct Spectrum {
    pub(super) points: Vec<(f64, f64)>,
    pub(super) lines: Vec<NamedLine>,
}

/// Spectrum of an observable of the state, up to the frequency `highest`, as it is drawn; lines below the `error` of the observable are none.
pub(super) fn spectrum(
    subject: &Subject,
    highest: f64,
    error: f64,
    observable: impl Fn(&BodyState<f64>) -> f64,
) -> Result<Spectrum, String> {
    let message = |error: twofold::Error| format!("{}: {error}", subject.name);
    let long = subject.long_motion()?;
    let series = Series::of_motion(&long.motion, SAMPLES, observable).map_err(message)?;
    let amplitudes = amplitude_spectrum(&series, WINDOW).map_err(message)?;
    let drawn = |omega: f64| subject.scale.frequency(omega);
    let points = amplitudes.points().map(|(omega, amplitude)| (drawn(omega), amplitude));
    let points: Vec<_> = points.take_while(|(frequency, _)| *frequency <= highest).collect();
    let strongest = points.iter().skip(1).map(|point| point.1).fold(0.0, f64::max);
    let basis = long.frequencies.as_ref().and_then(|frequencies| frequencies.basis().ok());
    let mut lines = Vec::new();
    let least = error.max(WEAKEST * strongest);
    if strongest > least {
        let found = spectral_lines(&series, least, MOST_FITTED).map_err(message)?;
        for line in found.lines.into_iter().take(MOST_LINES) {
            let identified = basis.as_ref().map(|basis| basis.identify(line.frequency, line.uncertainty));
            let combination = identified.and_then(|identified| identified.combination().cloned());
            lines.push(NamedLine { frequency: drawn(line.frequency), amplitude: line.amplitude, combination });
        }
    }
    Ok(Spectrum { points, lines })
}

/// What the symbols of mean rates in some names stand for.
pub(super) fn symbols_in(names: &[String]) -> String {
    let meanings = [
        ("*α*", "of the precession angle"),
        ("*γ*", "of the rotation angle"),
        ("*l*", "of the slow precession"),
        ("*ν*", "of nutation"),
        ("*ψ*", "of the rotation about the symmetry axis"),
    ];
    let named = meanings.iter().filter(|(symbol, _)| names.iter().any(|name| name.contains(symbol)));
    named.map(|(symbol, meaning)| format!("{symbol} {meaning}")).collect::<Vec<_>>().join(", ")
}

/// Lines as a table: frequency, amplitude, and how often each fundamental frequency is in it; all zero where it is not known.
pub(super) fn lines_table(name: String, lines: &[NamedLine], frequency: String, unit: &str) -> Table {
    const SYMBOLS: [&str; 5] = ["alpha'", "gamma'", "l'", "nu'", "psi'"];
    let multiples = SYMBOLS.map(|symbol| format!("multiple of {symbol} [1]"));
    let head = [frequency, format!("amplitude [{unit}]")];
    let mut table = Table::new(name, head.into_iter().chain(multiples));
    for line in lines {
        let multiple = |symbol: &&str| {
            let terms = line.combination.as_ref().map_or(&[][..], |combination| &combination.terms);
            terms.iter().find(|(_, found)| found == symbol).map_or(0.0, |(count, _)| f64::from(*count))
        };
        let mut row = vec![line.frequency, line.amplitude];
        row.extend(SYMBOLS.iter().map(multiple));
        table.push(row);
    }
    table
}

pub(super) fn sentence(clauses: &str) -> String {
    let mut letters = clauses.chars();
    letters.next().map_or(String::new(), |first| format!("{}{}.", first.to_uppercase(), letters.as_str()))
}

/// Words of the captions: length of the series, unit of frequencies, mean rates.
pub(super) fn of_series(subjects: &[&Subject]) -> Result<[(&'static str, String); 3], String> {
    let rates = subjects.iter().map(|subject| rates(subject)).collect::<Result<Vec<_>, _>>()?.join("; ");
    let unit = subjects[0].scale.frequency_unit().to_owned();
    Ok([("length", length_in_words(subjects)), ("unit", unit), ("rates", rates)])
}

fn rates(subject: &Subject) -> Result<String, String> {
    let Some(f) = &subject.long_motion()?.frequencies else {
        return Ok(format!("{}: none is certain over the length of the series", subject.name));
    };
    let named = [("*α*", f.alpha), ("*γ*", f.gamma), ("*l*", f.slow), ("*ν*", f.nutation)];
    let known = named.iter().filter_map(|(name, rate)| {
        let rate = (*rate)?;
        let [value, error] = [rate.value, rate.uncertainty].map(|omega| subject.scale.frequency(omega));
        // Digits that are not certain are said to be so, and a rate below its error is none.
        Some(match value.abs() {
            size if size <= error => format!("|{name}| < {}", significant(error, 1)),
            size if 1e-7 * size < error => {
                let digits = ((size / error).log10().floor() as usize + 1).min(7);
                format!("{name} = {} ± {}", significant(value, digits), significant(error, 1))
            }
            _ => format!("{name} = {}", significant(value, 7)),
        })
    });
    Ok(format!("{}: {}", subject.name, known.collect::<Vec<_>>().join(", ")))
}

fn length_in_words(subjects: &[&Subject]) -> String {
    let length = |s: &&Subject| format!("{} {}", number(s.scale.time(s.spectrum_duration)), s.scale.time_unit());
    let mut lengths: Vec<_> = subjects.iter().map(length).collect();
    lengths.dedup();
    lengths.join(" and ")
}

/// The highest frequency that a figure shows, as it is drawn: some times the rate of rotation, rounded up to half of its first digit.
pub(super) fn highest(subjects: &[&Subject], times: f64) -> f64 {
    let rate = |subject: &&Subject| subject.scale.frequency(SERIES_ROTATION / subject.spectrum_duration);
    let highest = times * subjects.iter().map(rate).fold(0.0, f64::max);
    let half = 10f64.powf(highest.log10().floor()) / 2.0;
    (highest / half).ceil() * half
}

/// Rotation over the length of a series (rad): 4,000 turns part the lines of tp-II, of which pairs are 0.0024 / t_c apart.
pub(super) const SERIES_ROTATION: f64 = 4000.0 * TAU;
