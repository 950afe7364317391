//! The cone of radiation and the line of sight.

use nalgebra::Vector3;
use twofold::observables::Observer;

use super::drawing::*;

/// Colatitude and azimuth of the beam's axis, half opening angle, colatitude and azimuth of the observer, as drawn.
const BEAM: [f64; 2] = [0.72, 0.8];
const HALF_OPENING: f64 = 0.26;
const OBSERVER: [f64; 2] = [1.05, 1.75];

pub(super) fn sheet() -> Result<Sheet, String> {
    let direction = |[theta, phi]: [f64; 2]| Observer::at(theta, phi).direction;
    let (m, n) = (direction(BEAM), direction(OBSERVER));
    let mut table = Table::new("", ["m along X Y Z [1]", "n along X Y Z [1]"]);
    for i in 0..3 {
        table.push([m[i], n[i]]);
    }
    Ok(Sheet { svg: draw(&m, &n), caption: caption(), tables: vec![table] })
}

fn draw(m: &Vector3<f64>, n: &Vector3<f64>) -> String {
    let mut page = Page::new("beam-cone", COLUMN, 190.0);
    let view = View::new([COLUMN / 2.0 - 34.0, 136.0], 112.0, 20.0, 20.0);
    for (axis, length, label) in [(Vector3::x(), 0.85, "*X*"), (Vector3::y(), 0.85, "*Y*"), (Vector3::z(), 1.08, "*Z*")]
    {
        view.arrow(&mut page, &(axis * length), solid(BLACK, 1.0));
        view.name(&mut page, &(axis * length), 8.0, BLACK, label);
    }

    // The cone up to the plane through the head of m.
    let u = m.cross(&Vector3::z()).normalize();
    let v = m.cross(&u);
    let rim: Vec<_> = arc(&u, &v, 0.0, std::f64::consts::TAU).iter().map(|p| m + p * HALF_OPENING.tan()).collect();
    page.area(&rim.iter().map(|p| view.at(p)).collect::<Vec<_>>(), "#dbe9f4");
    view.line(&mut page, &rim, solid(BLUE, 0.8));
    // The outline of the cone: its two lines farthest to either side of the axis on the page.
    let ([cx, cy], [mx, my]) = (view.at(&Vector3::zeros()), view.at(m));
    let angle = |p: &Vector3<f64>| {
        let [x, y] = view.at(p);
        ((mx - cx) * (y - cy) - (my - cy) * (x - cx)).atan2((x - cx) * (mx - cx) + (y - cy) * (my - cy))
    };
    let by_angle = |a: &&Vector3<f64>, b: &&Vector3<f64>| angle(a).total_cmp(&angle(b));
    let sides = [rim.iter().min_by(by_angle), rim.iter().max_by(by_angle)];
    for side in sides.into_iter().flatten() {
        view.line(&mut page, &[Vector3::zeros(), *side], solid(BLUE, 0.8));
    }

    for (direction, [theta, phi], colour, radius, names) in
        [(m, BEAM, BLUE, 0.3, ["**m**", "*Θ*", "*Φ*"]), (n, OBSERVER, VERMILION, 0.62, ["**n**", "*θ*_{o}", "*φ*_{o}"])]
    {
        let length = if colour == BLUE { 1.0 } else { 1.08 };
        let across = Vector3::new(phi.cos(), phi.sin(), 0.0);
        let foot = across * (length * theta.sin());
        let faint = dashed(if colour == BLUE { "#5f9fc9" } else { "#e39a66" }, 0.7);
        view.line(&mut page, &[Vector3::zeros(), foot, direction * length], faint);
        view.arrow(&mut page, &(direction * length), solid(colour, 1.4));
        view.name(&mut page, &(direction * length), 9.0, colour, names[0]);
        let arc_line = Line { width: 0.9, ..solid(colour, 0.9) };
        for (u, v, angle, name) in
            [(Vector3::z(), across, theta, names[1]), (Vector3::x(), Vector3::y(), phi, names[2])]
        {
            let points: Vec<_> = arc(&u, &v, 0.0, angle).iter().map(|p| p * radius).collect();
            view.line(&mut page, &points, arc_line);
            let part = if colour == BLUE { 50 } else { 22 };
            view.name(&mut page, &points[points.len() * part / 100], 7.5, colour, name);
        }
    }
    // The half opening angle, from the axis to one side of the outline.
    let side = sides[1].map_or(*m, |side| side.normalize());
    let across = (side - m * m.dot(&side)).normalize();
    let opening: Vec<_> = arc(m, &across, 0.0, HALF_OPENING).iter().map(|p| p * 0.8).collect();
    view.line(&mut page, &opening, solid(BLACK, 0.9));
    view.name(&mut page, &opening[opening.len() / 2], 8.0, BLACK, "*ρ*");
    page.circle(view.at(&Vector3::zeros()), 2.0, GREY, None);
    page.finish("Beam and line of sight")
}

fn caption() -> Caption {
    let numbers = [("theta", BEAM[0]), ("phi", BEAM[1]), ("rho", HALF_OPENING)];
    let of_observer = [("seen_at", OBSERVER[0]), ("seen_about", OBSERVER[1])];
    Caption::of("beam-cone", &numbers.into_iter().chain(of_observer).map(written).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The angles of the caption are those of the vectors.
    #[test]
    fn a_caption_has_the_angles_of_what_is_drawn() {
        let Sheet { caption, tables, .. } = sheet().unwrap();
        let vector = |column: usize| Vector3::from_fn(|i, _| tables[0].rows[i][column]);
        let [[theta, phi], [seen_at, seen_about]] = [0, 1].map(|column| {
            let v: Vector3<f64> = vector(column);
            [v.z.acos(), v.y.atan2(v.x)].map(|angle| significant(angle, 9))
        });
        let expected = format!(
            "Drawn for *Θ* = {theta}, *Φ* = {phi}, *ρ* = 0.26, *θ*_{{o}} = {seen_at}, *φ*_{{o}} = {seen_about} rad."
        );
        assert_eq!(caption.parameters, expected);
    }
}
