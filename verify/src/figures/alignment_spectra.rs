//! Spectra of `m.n`.

use super::axes::{Axis, BELOW, LEFT, Panel};
use super::parameters::{line_of_sight, parameters};
use super::spectrum::{self, Spectrum};
use super::style::{BLACK, PAGE, VERMILION, dashed, solid};
use super::svg::{Anchor, Page, Rectangle};
use super::table::Table;
use super::{Caption, Sheet, Subject};

/// Amplitudes that are shown; above the strongest line there is room for names.
const AMPLITUDES: (f64, f64) = (1e-5, 40.0);

/// Lines weaker than this have no names in the picture.
const NAMED: f64 = 3e-3;

pub(super) fn sheet(name: &str, subjects: &[&Subject]) -> Result<Sheet, String> {
    let highest = spectrum::highest(subjects, 2.2);
    let mut tables = Vec::new();
    let mut spectra = Vec::new();
    for subject in subjects {
        let (viewer, pulsar) = subject.line_of_sight()?;
        let (beam, observer) = (pulsar.beam(), viewer.basis());
        let of = spectrum::spectrum(subject, highest, |state| beam.direction(state).dot(&observer.direction))?;
        let mut table = Table::new(format!("{}-spectrum", subject.name), ["frequency [rad/t_c]", "amplitude [1]"]);
        of.points.iter().for_each(|&(frequency, amplitude)| table.push([frequency, amplitude]));
        tables.extend([table, spectrum::lines_table(format!("{}-lines", subject.name), &of.lines, "1")]);
        spectra.push(of);
    }
    let caption = caption(subjects, &spectra)?;
    Ok(Sheet { svg: draw(name, subjects, &spectra, highest), caption, tables })
}

fn draw(name: &str, subjects: &[&Subject], spectra: &[Spectrum], highest: f64) -> String {
    let (top, panel_height, gap) = (18.0, 118.0, 20.0);
    let count = subjects.len() as f64;
    let mut page = Page::new(name, PAGE, top + count * panel_height + (count - 1.0) * gap + BELOW);
    for (i, (subject, spectrum)) in subjects.iter().zip(spectra).enumerate() {
        let frame = Rectangle {
            left: LEFT,
            top: top + (panel_height + gap) * i as f64,
            width: PAGE - LEFT - 10.0,
            height: panel_height,
        };
        let x = Axis::linear("angular frequency × *t*_{c}", 0.0, highest);
        let last = i + 1 == subjects.len();
        let y = Axis::logarithmic("amplitude of **m** · **n**", AMPLITUDES.0, AMPLITUDES.1);
        let panel = Panel::new(frame, if last { x } else { x.bare() }, y);
        for rate in subject.free_rates() {
            panel.upright(&mut page, rate, dashed(VERMILION, 0.9));
        }
        let points: Vec<_> = spectrum.points.iter().map(|&(w, a)| (w, a.max(AMPLITUDES.0 / 10.0))).collect();
        panel.curve(&mut page, &points, solid(BLACK, 0.7));
        // Names stand upright over their lines, the strongest first, as far as there is room.
        let mut taken: Vec<f64> = Vec::new();
        for line in spectrum.lines.iter().filter(|line| line.amplitude > NAMED && line.frequency < highest) {
            let [x, y] = panel.at(line.frequency, line.amplitude);
            if let Some(name) = line.name().filter(|_| taken.iter().all(|other| (x - other).abs() > 8.4)) {
                // Clear of the ticks at the left.
                let baseline = (x + 2.5).max(frame.left + 10.5);
                page.turned_text([baseline, y - 3.0], -90.0, Anchor::Start, 7.0, BLACK, &name);
                taken.push(x);
            }
        }
        panel.draw_frame(&mut page);
        panel.letter(&mut page, i, subjects.len(), &subject.name);
    }
    page.finish("Spectra of the cosine of the angle between beam and line of sight")
}

fn caption(subjects: &[&Subject], spectra: &[Spectrum]) -> Result<Caption, String> {
    let rates = subjects.iter().map(|subject| spectrum::rates(subject)).collect::<Result<Vec<_>, _>>()?;
    let counts = subjects.iter().zip(spectra).map(|(subject, spectrum)| {
        let known = spectrum.lines.iter().filter(|line| line.combination.is_some()).count();
        format!("{known} of the {} strongest lines of {} are such combinations", spectrum.lines.len(), subject.name)
    });
    let mut says = format!("{}.", counts.collect::<Vec<_>>().join("; "));
    if subjects.len() > 1 {
        says += " The peaks stand beside the dashed lines: Lorentz violation shifts the rates. The smallest frequency of tp-II, *l*, is that \
                 at which its angular momentum goes round *Z*; tp-I has it too, but 600 times weaker than its strongest line.";
    }
    Ok(Caption {
        shows: "Amplitude spectra of **m** · **n**. Names over the lines are combinations of mean rates; *α*, *γ* and *l* in them stand for the mean \
                rates of change of precession angle, rotation angle and slow precession (*ν*: nutation). Dashed: *α* and |*γ*| of free precession, Eq. (48)."
            .to_owned(),
        parameters: parameters(&line_of_sight(subjects, true), subjects),
        method: format!(
            "Fourier transform of 49,152 values over {} with Kaiser's window (shape 14); lines by a joint fit, to 10^{{−5}} of the strongest; mean rates \
             by weighted averages. Mean rates per *t*_{{c}}: {}.",
            spectrum::length_in_words(subjects),
            rates.join("; ")
        ),
        says,
    })
}
