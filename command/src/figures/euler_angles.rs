//! The Euler angles between two frames.

use nalgebra::Vector3;
use twofold::euler_angles::{EulerAngles, body_from_inertial};

use super::drawing::*;
use super::markup::plain;

const ANGLES: EulerAngles<f64> = EulerAngles { alpha: 1.0, beta: 0.8, gamma: 0.9 };

const INERTIAL: Line = solid(BLACK, 1.0);
const BODY: Line = solid(BLUE, 1.2);
const ARC: Line = solid(VERMILION, 1.0);

/// Figure for X-Y-Z and x-y-z.
pub(super) fn common() -> Result<Sheet, String> {
    sheet("euler-angles", ["*X*", "*Y*", "*Z*"], ["*M*", "*N*"], "*X*-*Y*-*Z*")
}

/// Figure for Y-Z-X and x-y-z, for forced precession about X.
pub(super) fn permuted() -> Result<Sheet, String> {
    sheet("euler-angles-yzx", ["*Y*", "*Z*", "*X*"], ["*P*", "*Q*"], "*Y*-*Z*-*X*")
}

fn sheet(name: &str, axes: [&str; 3], nodes: [&str; 2], frame: &str) -> Result<Sheet, String> {
    let rotation = body_from_inertial(&ANGLES);
    let body = [0, 1, 2].map(|i| rotation.row(i).transpose());
    let (sin, cos) = ANGLES.alpha.sin_cos();
    let node = Vector3::new(cos, sin, 0.0);
    let along = axes.map(plain).join(" ");
    let vectors = ["e_x", "e_y", "e_z", "line of nodes"].map(|vector| format!("{vector} along {along} [1]"));
    let mut table = Table::new("", vectors);
    for i in 0..3 {
        table.push([body[0][i], body[1][i], body[2][i], node[i]]);
    }
    Ok(Sheet { svg: draw(name, axes, nodes, &body, &node), caption: caption(axes, nodes, frame), tables: vec![table] })
}

fn draw(name: &str, axes: [&str; 3], nodes: [&str; 2], body: &[Vector3<f64>; 3], node: &Vector3<f64>) -> String {
    let height = 196.0;
    let mut page = Page::new(name, COLUMN, height);
    let view = View::new([COLUMN / 2.0, 108.0], 82.0, 22.0, 24.0);
    let full = std::f64::consts::TAU;
    let plane = |page: &mut Page, u: &Vector3<f64>, v: &Vector3<f64>, line: Line| {
        let back = Line { width: 0.6, ..dashed(line.colour, 0.6) };
        view.line_on_sphere(page, &arc(u, v, 0.0, full), line, Some(back));
    };
    plane(&mut page, &Vector3::x(), &Vector3::y(), solid(GREY, 0.8));
    plane(&mut page, &body[0], &body[1], solid("#5f9fc9", 0.8));
    view.line(&mut page, &[-node, *node], dashed(VERMILION, 0.9));

    for (axis, label) in [Vector3::x(), Vector3::y(), Vector3::z()].iter().zip(axes) {
        view.arrow(&mut page, axis, INERTIAL);
        view.name(&mut page, axis, 8.0, BLACK, label);
    }
    for (axis, label) in body.iter().zip(["*x*", "*y*", "*z*"]) {
        view.arrow(&mut page, axis, BODY);
        view.name(&mut page, axis, 8.0, BLUE, label);
    }
    for (end, label) in [(-node, nodes[0]), (*node, nodes[1])] {
        page.circle(view.at(&end), 1.5, VERMILION, None);
        view.name(&mut page, &end, 8.0, VERMILION, label);
    }

    // Arcs from X to the node, from Z to z and from the node to x.
    let across = Vector3::new(-node.y, node.x, 0.0);
    let arcs = [
        (Vector3::x(), Vector3::y(), ANGLES.alpha, 0.42, "*α*"),
        (Vector3::z(), -across, ANGLES.beta, 0.5, "*β*"),
        (*node, body[2].cross(node), ANGLES.gamma, 0.62, "*γ*"),
    ];
    for (u, v, angle, radius, label) in arcs {
        let points: Vec<_> = arc(&u, &v, 0.0, angle).iter().map(|p| p * radius).collect();
        let last = points.len() - 1;
        view.line(&mut page, &points[..last - 12], ARC);
        page.arrow(view.at(&points[last - 14]), view.at(&points[last]), ARC);
        let middle = points[points.len() / 2];
        let [x, y] = view.at(&middle);
        let [cx, cy] = view.at(&Vector3::zeros());
        let length = (x - cx).hypot(y - cy);
        page.name([x + 7.0 * (x - cx) / length, y + 7.0 * (y - cy) / length], VERMILION, label);
    }
    page.circle(view.at(&Vector3::zeros()), 1.2, LIGHT, None);
    page.finish("Euler angles")
}

fn caption(axes: [&str; 3], nodes: [&str; 2], frame: &str) -> Caption {
    let [first, second, third] = axes;
    // One italic run: two adjacent ones would be the mark of bold.
    let line = format!("*{}*", nodes.map(plain).concat());
    let [permuted, forced] = match third {
        "*X*" => [
            " in the frame permuted by Eq. (36)",
            ": with these angles the solutions apply to forced precession about *X*",
        ],
        _ => ["", ""],
    };
    let EulerAngles { alpha, beta, gamma } = ANGLES;
    let words = [("frame", frame), ("line", &line), ("first", first), ("second", second), ("third", third)];
    let angles = [("alpha", alpha), ("beta", beta), ("gamma", gamma)].map(written);
    let words = words.into_iter().chain([("permuted", permuted), ("forced", forced)]).map(written);
    Caption::of("euler-angles", &words.chain(angles).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::super::drawn::{elements, texts};
    use super::*;

    /// `e_z` is at the angle `beta` from Z and normal to the line of nodes, which is at `alpha` from X; `e_x` is at `gamma` from that line.
    #[test]
    fn the_table_has_the_axes_that_the_angles_turn() {
        let EulerAngles { alpha, beta, gamma } = ANGLES;
        let node = Vector3::new(alpha.cos(), alpha.sin(), 0.0);
        let z = Vector3::new(beta.sin() * alpha.sin(), -beta.sin() * alpha.cos(), beta.cos());
        let across = z.cross(&node);
        let (x, y) = (node * gamma.cos() + across * gamma.sin(), across * gamma.cos() - node * gamma.sin());
        for sheet in [common(), permuted()] {
            let table = &sheet.unwrap().tables[0];
            for (k, expected) in [x, y, z, node].iter().enumerate() {
                let found = Vector3::from_iterator(table.rows.iter().map(|row| row[k]));
                assert!((found - expected).norm() < 1e-15, "{}: {found}", table.columns[k]);
            }
        }
    }

    /// The second name of the line of nodes is at its ascending end, `alpha` from the first axis.
    #[test]
    fn the_ends_of_the_line_of_nodes_have_their_names() {
        for (sheet, [first, second, descending, ascending]) in
            [(common(), ["X", "Y", "M", "N"]), (permuted(), ["Y", "Z", "P", "Q"])]
        {
            let elements = elements(&sheet.unwrap().svg);
            let at = |name: &str| texts(&elements).find(|text| text.words == name).expect("a name").at;
            let [first, second, descending, ascending] = [first, second, descending, ascending].map(at);
            let centre = [0, 1].map(|k| (descending[k] + ascending[k]) / 2.0);
            let (sin, cos) = ANGLES.alpha.sin_cos();
            // The page is a projection of space, and the names of axes are at about equal distances.
            let along = |k: usize| (first[k] - centre[k]) * cos + (second[k] - centre[k]) * sin;
            let to_the_name = |k: usize| ascending[k] - centre[k];
            let [cosine, sine] = [
                along(0) * to_the_name(0) + along(1) * to_the_name(1),
                along(0) * to_the_name(1) - along(1) * to_the_name(0),
            ];
            assert!(cosine > 10.0 * sine.abs(), "{cosine} {sine}");
        }
    }
}
