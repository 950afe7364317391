//! `m.n`, the cosine of the angle between the beam and the line of sight, against time.

use super::drawing::*;

pub(super) fn sheet(name: &str, subjects: &[&Subject]) -> Result<Sheet, String> {
    let tables = subjects.iter().map(|subject| alignment(subject)).collect::<Result<Vec<_>, _>>()?;
    Ok(Sheet { svg: draw(name, subjects, &tables), caption: caption(subjects, &tables), tables })
}

/// `cos rho`; a scene without a beam has no such figure.
fn edge(subject: &Subject) -> f64 {
    subject.pulsar.map_or(f64::NAN, |pulsar| pulsar.rho.cos())
}

fn alignment(subject: &Subject) -> Result<Table, String> {
    let (viewer, pulsar) = subject.line_of_sight()?;
    let (beam, observer) = (pulsar.beam(), viewer.basis());
    let mut table = Table::new(&subject.name, [subject.scale.time_column("t"), "m.n [1]".to_owned()]);
    for t in times(subject.shown.beam, 4000) {
        table.push([subject.scale.time(t), beam.direction(&subject.state(t)?).dot(&observer.direction)]);
    }
    Ok(table)
}

fn draw(name: &str, subjects: &[&Subject], tables: &[Table]) -> String {
    let grid = Grid { left: LEFT, top: 18.0, width: PAGE - LEFT - 34.0, height: 84.0, between: [0.0, 30.0] };
    let mut page = Page::new(name, PAGE, grid.bottom(subjects.len()) + BELOW);
    for (i, (subject, table)) in subjects.iter().zip(tables).enumerate() {
        let x = subject.scale.time_axis(subject.shown.beam);
        let values = table.rows.iter().map(|row| row[1]);
        let edge = edge(subject);
        let y = Axis::around("**m** · **n**", values.chain([edge]));
        let panel = Panel::new(grid.frame(0, i), if i + 1 < subjects.len() { x.unnamed() } else { x }, y);
        let points = table.points(0, 1);
        panel.curve(&mut page, &points, solid(BLACK, 0.6));
        for pulse in points.chunk_by(|a, b| (a.1 > edge) == (b.1 > edge)).filter(|piece| piece[0].1 > edge) {
            panel.curve(&mut page, pulse, solid(BLUE, 1.7));
        }
        panel.level(&mut page, edge, dashed(VERMILION, 1.0));
        let [x, y] = panel.at(subject.scale.time(subject.shown.beam).max(0.0), edge);
        page.text([x + 3.0, y + 0.35 * SMALL], Anchor::Start, SMALL, VERMILION, "cos *ρ*");
        panel.draw_frame(&mut page);
        panel.letter(&mut page, i, subjects.len(), &subject.name);
    }
    page.finish("Cosine of the angle between the beam and the line of sight in time")
}

fn caption(subjects: &[&Subject], tables: &[Table]) -> Caption {
    let part = |(subject, table): (&&Subject, &Table)| {
        let edge = edge(subject);
        table.rows.iter().filter(|row| row[1] > edge).count() as f64 / table.rows.len() as f64
    };
    let parts: Vec<_> = subjects.iter().zip(tables).map(part).collect();
    let pulses = if parts.iter().any(|part| *part > 0.0) { ": thick stretches are pulses" } else { "" };
    let in_words = |(subject, part): (&&Subject, &f64)| match *part {
        0.0 => format!("at none of the {} times drawn for {}", tables[0].rows.len(), subject.name),
        1.0 => format!("all the time for {}", subject.name),
        part => format!("{} % of the time for {}", significant(100.0 * part, 2), subject.name),
    };
    let parts: Vec<_> = subjects.iter().zip(&parts).map(in_words).collect();
    let text = |part, words: &[_]| sentences("beam-alignment", part, words);
    Caption {
        shows: text("shows", &[("pulses", pulses.to_owned())]),
        parameters: parameters(&line_of_sight(subjects, true), subjects),
        method: text("method", &[("kind", subjects[0].kind().to_owned())]),
        says: format!("The line of sight is inside the beam {}.", parts.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::caption_tests::assert_begins;
    use crate::figures::fixtures::free;

    /// The edge of a beam of 0.6 rad is at a cosine of 0.8253.
    #[test]
    fn a_caption_tells_how_much_of_the_time_is_inside_the_beam() {
        let stars = ["a", "b", "c"].map(free);
        let table = |values: [f64; 3]| {
            let mut table = Table::new("", ["t", "m.n"]);
            values.iter().for_each(|value| table.push([0.0, *value]));
            table
        };
        let [never, always, at_times] = [[0.1, -0.9, 0.82], [0.83, 0.9, 1.0], [0.83, 0.1, -0.9]].map(table);
        assert_begins(
            &caption(&stars.each_ref(), &[never.clone(), always, at_times.clone()]),
            [
                "Cosine of the angle between",
                "*θ*_{o} = 0.8, *φ*_{o} = 0, *χ* = 0.5, *δ* = 0, *ρ* = 0.6. *ε* = 0.1",
                "Along the numerical motion; **m** by Eq. (45)",
                "The line of sight is inside the beam at none of the 3 times drawn for a, all the time for b, 33 % of the time for c.",
            ],
        );
        let pulses = |table: &Table| caption(&[&stars[0]], std::slice::from_ref(table)).shows.contains("pulses");
        assert_eq!([pulses(&never), pulses(&at_times)], [false, true]);
    }
}
