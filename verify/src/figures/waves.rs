//! `h_+` and `h_x` at the observer in time.

use twofold::dynamics::inertia_tensor_rate::spheroid_inertia_acceleration;
use twofold::observables::gravitational_wave::{Polarizations, metric_perturbation, polarizations};

use super::axes::{Axis, BELOW, LEFT, Panel};
use super::parameters::{line_of_sight, parameters};
use super::style::{BLUE, PAGE, VERMILION, solid};
use super::subject::times;
use super::svg::{Page, Rectangle};
use super::table::Table;
use super::{Caption, Sheet, Subject};

pub(super) fn sheet(name: &str, subjects: &[&Subject]) -> Result<Sheet, String> {
    let tables = subjects.iter().map(|subject| waves(subject)).collect::<Result<Vec<_>, _>>()?;
    Ok(Sheet { svg: draw(name, subjects, &tables), caption: caption(subjects), tables })
}

/// The two polarizations at a time, at the distance one.
pub(super) fn wave(subject: &Subject, t: f64) -> Result<Polarizations<f64>, String> {
    let (start, state) = (&subject.start, subject.state(t)?);
    let source = spheroid_inertia_acceleration(&start.spheroid, &start.violation, &state.axis, &state.momentum);
    Ok(polarizations(&subject.viewer()?.basis(), &metric_perturbation(1.0, &source)))
}

fn waves(subject: &Subject) -> Result<Table, String> {
    let columns = ["t [t_c]", "h_+ [G I^xx / (c^4 t_c^2 r)]", "h_x [G I^xx / (c^4 t_c^2 r)]"];
    let mut table = Table::new(&subject.name, columns);
    for t in times(subject.shown.waves, 2000) {
        let h = wave(subject, t)?;
        table.push([t, h.plus, h.cross]);
    }
    Ok(table)
}

fn draw(name: &str, subjects: &[&Subject], tables: &[Table]) -> String {
    let (top, panel_height, gap, between) = (18.0, 74.0, 8.0, 44.0);
    let count = subjects.len() as f64;
    let width = (PAGE - LEFT - 8.0 - (count - 1.0) * between) / count;
    let mut page = Page::new(name, PAGE, top + 2.0 * panel_height + gap + BELOW);
    // One scale for both stars and polarizations, so that sizes can be compared.
    let values = || tables.iter().flat_map(|table| table.rows.iter().flat_map(|row| [row[1], row[2]]));
    for (i, (subject, table)) in subjects.iter().zip(tables).enumerate() {
        let shown = subject.shown.waves;
        let x = Axis::linear("*t* / *t*_{c}", shown.min(0.0), shown.max(0.0));
        for (polarization, (label, colour)) in
            [("*h*_{+} *r* / *I*^{*xx*}", BLUE), ("*h*_{×} *r* / *I*^{*xx*}", VERMILION)].into_iter().enumerate()
        {
            let frame = Rectangle {
                left: LEFT + (width + between) * i as f64,
                top: top + (panel_height + gap) * polarization as f64,
                width,
                height: panel_height,
            };
            let x = if polarization == 0 { x.bare() } else { x.clone() };
            let panel = Panel::new(frame, x, Axis::around(label, values()));
            panel.curve(&mut page, &table.points(0, 1 + polarization), solid(colour, 0.9));
            panel.draw_frame(&mut page);
            if polarization == 0 {
                panel.letter(&mut page, i, subjects.len(), &subject.name);
            }
        }
    }
    page.finish("Gravitational waves in time")
}

fn caption(subjects: &[&Subject]) -> Caption {
    Caption {
        shows: "Quadrupole waves *h*_{+} and *h*_{×} at the observer in time; *h* *r* / *I*^{*xx*} counts multiples of \
                *G* / (*c*^{4} *t*_{c}^{2})."
            .to_owned(),
        parameters: parameters(&line_of_sight(subjects, false), subjects),
        method: "Numerical motion; second time derivative of the moment of inertia, Eqs. (64), (65), in the form for a spheroid; \
                 *h*^{*IJ*} by Eq. (59) and the polarizations by Eqs. (69)-(71)."
            .to_owned(),
        says: if subjects.len() > 1 {
            "For tp-I the wave is nearly that of a freely precessing star, two lines at the rate of *α* and twice that. For tp-II \
             the axis of precession itself is tilted to *Z* and goes round, which changes the shape of the wave slowly."
                .to_owned()
        } else {
            "Sizes of the two polarizations can be compared: the scales are the same.".to_owned()
        },
    }
}
