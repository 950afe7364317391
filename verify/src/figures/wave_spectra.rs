//! Spectra of `h_+` and `h_x`, with the third harmonic enlarged.

use twofold::dynamics::inertia_tensor_rate::spheroid_inertia_acceleration;
use twofold::observables::gravitational_wave::{metric_perturbation, polarizations};

use super::axes::{Axis, BELOW, LEFT, Panel};
use super::parameters::{line_of_sight, parameters};
use super::spectrum::{self, NamedLine, Spectrum};
use super::style::{BLACK, Line, PAGE, SMALL, VERMILION, dashed, dotted, solid};
use super::svg::{Anchor, Page, Rectangle};
use super::table::Table;
use super::{Caption, Sheet, Subject};

const LINE: Line = solid(BLACK, 0.8);

/// An amplitude that is the rounding of none.
const NOTHING: f64 = 1e-15;

/// Half of the width of the inset, in frequency.
const INSET: f64 = 0.32;

pub(super) fn sheet(name: &str, subjects: &[&Subject]) -> Result<Sheet, String> {
    let highest = spectrum::highest(subjects, 3.7);
    let mut tables = Vec::new();
    let mut spectra = Vec::new();
    for subject in subjects {
        let start = &subject.start;
        let observer = subject.viewer()?.basis();
        let wave = |state: &twofold::dynamics::BodyState<f64>| {
            let source = spheroid_inertia_acceleration(&start.spheroid, &start.violation, &state.axis, &state.momentum);
            polarizations(&observer, &metric_perturbation(1.0, &source))
        };
        let both = [
            spectrum::spectrum(subject, highest, |state| wave(state).plus)?,
            spectrum::spectrum(subject, highest, |state| wave(state).cross)?,
        ];
        let unit = "G I^xx / (c^4 t_c^2 r)";
        let columns = ["frequency [rad/t_c]".to_owned(), format!("h_+ [{unit}]"), format!("h_x [{unit}]")];
        let mut table = Table::new(format!("{}-spectrum", subject.name), columns);
        for (plus, cross) in both[0].points.iter().zip(&both[1].points) {
            table.push([plus.0, plus.1, cross.1]);
        }
        tables.push(table);
        for (polarization, spectrum) in ["plus", "cross"].iter().zip(&both) {
            tables.push(spectrum::lines_table(format!("{}-{polarization}-lines", subject.name), &spectrum.lines, unit));
        }
        spectra.push(both);
    }
    let caption = caption(subjects, &spectra)?;
    Ok(Sheet { svg: draw(name, subjects, &spectra, highest)?, caption, tables })
}

/// The rate of which the wave has harmonics: that of `alpha`.
fn fundamental(subject: &Subject) -> Result<Option<f64>, String> {
    let frequencies = &subject.long_motion()?.frequencies;
    Ok(frequencies.as_ref().and_then(|f| f.alpha).filter(|rate| rate.uncertainty < 1e-6).map(|rate| rate.value.abs()))
}

fn draw(name: &str, subjects: &[&Subject], spectra: &[[Spectrum; 2]], highest: f64) -> Result<String, String> {
    let (top, height, gap, between) = (18.0, 98.0, 8.0, 44.0);
    let count = subjects.len() as f64;
    let width = (PAGE - LEFT - 8.0 - (count - 1.0) * between) / count;
    let mut page = Page::new(name, PAGE, top + 2.0 * height + gap + BELOW);
    // One scale for both stars and polarizations, so that sizes can be compared.
    let most = spectra.iter().flatten().flat_map(|s| s.points.iter().skip(1).map(|p| p.1)).fold(NOTHING, f64::max);
    for (i, (subject, both)) in subjects.iter().zip(spectra).enumerate() {
        let third = fundamental(subject)?.map(|rate| 3.0 * rate).filter(|third| third + INSET < highest);
        for (polarization, (spectrum, symbol)) in both.iter().zip(["*h*_{+}", "*h*_{×}"]).enumerate() {
            let frame = Rectangle {
                left: LEFT + (width + between) * i as f64,
                top: top + (height + gap) * polarization as f64,
                width,
                height,
            };
            let x = Axis::linear("angular frequency × *t*_{c}", 0.0, highest);
            let y = Axis::linear(&format!("amplitude of {symbol}"), 0.0, 1.05 * most);
            let panel = Panel::new(frame, if polarization == 0 { x.bare() } else { x }, y);
            if let Some(free) = subject.free_rates().first() {
                [*free, 2.0 * free].iter().for_each(|rate| panel.upright(&mut page, *rate, dashed(VERMILION, 0.9)));
            }
            panel.curve(&mut page, &spectrum.points, LINE);
            panel.draw_frame(&mut page);
            if polarization == 0 {
                panel.letter(&mut page, i, subjects.len(), &subject.name);
            }
            if let Some(third) = third {
                inset(&mut page, frame, third, spectrum);
            }
        }
    }
    Ok(page.finish("Spectra of the gravitational waves"))
}

/// The part of the spectrum around `centre` at a scale of its own, in the upper right of the frame.
fn inset(page: &mut Page, frame: Rectangle, centre: f64, spectrum: &Spectrum) {
    let part: Vec<_> = spectrum.points.iter().filter(|point| (point.0 - centre).abs() < INSET).copied().collect();
    let most = part.iter().map(|point| point.1).fold(NOTHING, f64::max);
    let inner = Rectangle {
        left: frame.left + 0.65 * frame.width,
        top: frame.top + 17.0,
        width: 0.31 * frame.width,
        height: 0.48 * frame.height,
    };
    let x = Axis::linear("", centre - INSET, centre + INSET);
    let panel = Panel::new(inner, x, Axis::linear("", 0.0, 1.15 * most));
    panel.upright(page, centre, dotted("#404040", 0.8));
    panel.curve(page, &part, LINE);
    panel.draw_frame(page);
    let power = match panel.y_power() {
        0 => String::new(),
        power => format!(" [10^{{{}}}]", super::axes::signed(&power.to_string())),
    };
    page.text([inner.right(), inner.top - 4.0], Anchor::End, SMALL, "#000000", &format!("near 3 d*α*/d*t*{power}"));
}

fn caption(subjects: &[&Subject], spectra: &[[Spectrum; 2]]) -> Result<Caption, String> {
    let rates = subjects.iter().map(|subject| spectrum::rates(subject)).collect::<Result<Vec<_>, _>>()?;
    let mut says = Vec::new();
    for (subject, [plus, _]) in subjects.iter().zip(spectra) {
        let Some(first) = plus.lines.first() else { continue };
        let name = |line: &NamedLine| line.name().unwrap_or_else(|| format!("at {:.4} / *t*_{{c}}", line.frequency));
        let multiple = |line: &NamedLine, symbol: &str| {
            let terms = line.combination.as_ref().map_or(&[][..], |combination| &combination.terms);
            terms.iter().find(|(_, found)| *found == symbol).map_or(0, |(count, _)| count.abs())
        };
        says.push(format!("The strongest line in *h*_{{+}} of {} is {}", subject.name, name(first)));
        if let Some(third) = plus.lines.iter().find(|line| multiple(line, "alpha'") == 3) {
            let part = scientific(third.amplitude / first.amplitude);
            says.push(format!("the strongest of the third harmonic, {}, has {part} of it", name(third)));
        }
        let slow = plus.lines.iter().find(|line| multiple(line, "l'") == 1 && multiple(line, "alpha'") == 0);
        says.push(match slow {
            Some(slow) => {
                let part = scientific(slow.amplitude / first.amplitude);
                format!("the slow frequency *l* by itself has {part} of it, too little for the picture. ")
            }
            None => "the slow frequency *l* is not among its lines. ".to_owned(),
        });
    }
    let says = says.join(", ").replace(". , ", ". ").trim_end().to_owned();
    let says = if says.is_empty() { "The star does not radiate.".to_owned() } else { says };
    Ok(Caption {
        shows: "Amplitude spectra of *h*_{+} (top) and *h*_{×} (bottom), in units of *G* *I*^{*xx*} / (*c*^{4} *t*_{c}^{2} *r*); the insets enlarge what is near three times the mean rate of *α* (dotted). \
                Dashed: *α* and 2*α* of free precession, Eq. (48)."
            .to_owned(),
        parameters: parameters(&line_of_sight(subjects, false), subjects),
        method: format!(
            "Waves by Eqs. (59), (64), (65), (69)-(71); Fourier transform of 49,152 values over {} with Kaiser's window (shape 14); lines by a joint fit, to \
             10^{{−5}} of the strongest. Mean rates per *t*_{{c}}: {}.",
            spectrum::length_in_words(subjects),
            rates.join("; ")
        ),
        says,
    })
}

/// `2.5 × 10^{−3}`.
fn scientific(x: f64) -> String {
    let power = x.log10().floor();
    format!("{:.1} × 10^{{{}}}", x / 10f64.powf(power), super::axes::signed(&format!("{power:.0}")))
}
