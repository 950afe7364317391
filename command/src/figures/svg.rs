//! A page of SVG: lines, areas, marks and text. Lengths are in points, y downwards.

use std::fmt::Write;

use super::markup::{Level, escaped, runs};
use super::style::{CENTIMETRE, FONTS, LABEL, Line};

pub(super) type At = [f64; 2];

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rectangle {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Rectangle {
    pub(super) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(super) fn bottom(&self) -> f64 {
        self.top + self.height
    }
}

/// The reference point of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// Smallest size of letters, including subscripts and superscripts.
const SMALLEST: f64 = 7.0;

#[derive(Debug)]
pub(super) struct Page {
    name: String,
    width: f64,
    height: f64,
    body: String,
    clips: usize,
}

impl Page {
    /// An empty page for the figure `name`, which makes its ids unique in a document with several figures.
    pub(super) fn new(name: &str, width: f64, height: f64) -> Self {
        Self { name: name.to_owned(), width, height, body: String::new(), clips: 0 }
    }

    /// The SVG document; `title` describes it for readers who do not see it.
    pub(super) fn finish(self, title: &str) -> String {
        let Self { width, height, body, .. } = self;
        let (title, centimetres) = (escaped(&super::markup::plain(title)), |points: f64| points / CENTIMETRE);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.3}cm\" height=\"{:.3}cm\" viewBox=\"0 0 {width:.2} \
             {height:.2}\" role=\"img\" font-family=\"{FONTS}\" stroke-linejoin=\"round\">\n<title>{title}</title>\n\
             <rect width=\"{width:.2}\" height=\"{height:.2}\" fill=\"#ffffff\"/>\n{body}</svg>\n",
            centimetres(width),
            centimetres(height),
        )
    }

    fn write(&mut self, element: std::fmt::Arguments<'_>) {
        // Writing to a String cannot fail.
        let _ = self.body.write_fmt(element);
        self.body.push('\n');
    }

    pub(super) fn path(&mut self, points: &[At], line: Line) {
        if points.len() > 1 {
            let data = path_data(points);
            self.write(format_args!("<path d=\"{data}\" fill=\"none\"{}/>", stroke(line)));
        }
    }

    pub(super) fn outline(&mut self, r: Rectangle, line: Line) {
        let (right, bottom) = (r.right(), r.bottom());
        self.path(&[[r.left, r.top], [right, r.top], [right, bottom], [r.left, bottom], [r.left, r.top]], line);
    }

    /// A filled polygon without a border.
    pub(super) fn area(&mut self, points: &[At], fill: &str) {
        let data = path_data(points);
        self.write(format_args!("<path d=\"{data}Z\" fill=\"{fill}\"/>"));
    }

    /// A filled rectangle that extends slightly over its lower and right sides, so that there is no seam between neighbours.
    pub(super) fn cell(&mut self, r: Rectangle, fill: &str) {
        self.write(format_args!(
            "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"{fill}\" shape-rendering=\"crispEdges\"/>",
            r.left,
            r.top,
            r.width + OVERLAP,
            r.height + OVERLAP
        ));
    }

    pub(super) fn circle(&mut self, [x, y]: At, radius: f64, fill: &str, line: Option<Line>) {
        let stroke = line.map(stroke).unwrap_or_default();
        self.write(format_args!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius:.2}\" fill=\"{fill}\"{stroke}/>"));
    }

    /// A line that ends in an arrow head.
    pub(super) fn arrow(&mut self, from: At, to: At, line: Line) {
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let length = dx.hypot(dy);
        let head = (3.0 + 2.4 * line.width).min(0.7 * length);
        let (ux, uy) = (dx / length, dy / length);
        let along = |back: f64, side: f64| [to[0] - ux * back - uy * side, to[1] - uy * back + ux * side];
        self.path(&[from, along(0.8 * head, 0.0)], line);
        self.area(&[to, along(head, 0.36 * head), along(0.75 * head, 0.0), along(head, -0.36 * head)], line.colour);
    }

    /// Text with markup on one line, with its baseline at `at`.
    pub(super) fn text(&mut self, at: At, anchor: Anchor, size: f64, colour: &str, text: &str) {
        self.turned_text(at, 0.0, anchor, size, colour, text);
    }

    /// A label in black at the usual size.
    pub(super) fn label(&mut self, at: At, anchor: Anchor, text: &str) {
        self.text(at, anchor, LABEL, "#000000", text);
    }

    /// Text centred at `at`, with a white edge that keeps it legible over lines.
    pub(super) fn name(&mut self, [x, y]: At, colour: &str, text: &str) {
        let edge = " stroke=\"#ffffff\" stroke-width=\"2.2\" paint-order=\"stroke\"";
        self.spans([x, y + 0.35 * LABEL], Anchor::Middle, LABEL, colour, text, edge);
    }

    /// Text turned by `degrees` about `at`, clockwise.
    pub(super) fn turned_text(
        &mut self,
        [x, y]: At,
        degrees: f64,
        anchor: Anchor,
        size: f64,
        colour: &str,
        text: &str,
    ) {
        let turn =
            if degrees == 0.0 { String::new() } else { format!(" transform=\"rotate({degrees} {x:.2} {y:.2})\"") };
        self.spans([x, y], anchor, size, colour, text, &turn);
    }

    fn spans(&mut self, [x, y]: At, anchor: Anchor, size: f64, colour: &str, text: &str, attributes: &str) {
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let mut spans = String::new();
        let mut shift = 0.0;
        for run in runs(text) {
            let (wanted, run_size) = match run.level {
                Level::Line => (0.0, size),
                Level::Below => (0.24 * size, (0.76 * size).max(SMALLEST)),
                Level::Above => (-0.36 * size, (0.76 * size).max(SMALLEST)),
            };
            let mut style = String::new();
            if run_size != size {
                style += &format!(" font-size=\"{run_size:.2}\"");
            }
            if wanted != shift {
                style += &format!(" dy=\"{:.2}\"", wanted - shift);
            }
            if run.italic {
                style += " font-style=\"italic\"";
            }
            if run.bold {
                style += " font-weight=\"bold\"";
            }
            let inner = escaped(&run.text);
            spans += &if style.is_empty() { inner } else { format!("<tspan{style}>{inner}</tspan>") };
            shift = wanted;
        }
        self.write(format_args!(
            "<text x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"{size}\"{anchor}{attributes} fill=\"{colour}\" xml:space=\"preserve\">{spans}</text>"
        ));
    }

    /// The output of `draw`, clipped to `r`.
    pub(super) fn clipped(&mut self, r: Rectangle, draw: impl FnOnce(&mut Self)) {
        self.clips += 1;
        let id = format!("{}-clip-{}", self.name, self.clips);
        self.write(format_args!(
            "<clipPath id=\"{id}\"><rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\"/></clipPath>\n<g clip-path=\"url(#{id})\">",
            r.left, r.top, r.width, r.height
        ));
        draw(self);
        self.write(format_args!("</g>"));
    }
}

/// Overlap of neighbouring cells: more than a pixel of the PNG, less than half of a line around all of them.
const OVERLAP: f64 = 0.3;

fn stroke(line: Line) -> String {
    let dashes = if line.dashes.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{}\"", line.dashes) };
    format!(" stroke=\"{}\" stroke-width=\"{}\"{dashes}", line.colour, line.width)
}

/// Points closer than this to the line between their neighbours are left out: 0.02 pt, a twentieth of a thin line.
const FLATNESS: f64 = 0.02;

fn path_data(points: &[At]) -> String {
    let mut data = String::new();
    for [x, y] in simplified(points) {
        let command = if data.is_empty() { 'M' } else { 'L' };
        let _ = write!(data, "{command}{x:.2} {y:.2}");
    }
    data
}

/// Ramer, Douglas and Peucker: the fewest points from which the line differs by [`FLATNESS`] at most.
fn simplified(points: &[At]) -> Vec<At> {
    let mut kept = vec![false; points.len()];
    let mut pieces = vec![(0, points.len().saturating_sub(1))];
    while let Some((first, last)) = pieces.pop() {
        (kept[first], kept[last]) = (true, true);
        let farthest = (first + 1..last)
            .map(|i| (distance_to_piece(points[i], points[first], points[last]), i))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((distance, i)) = farthest
            && distance > FLATNESS
        {
            pieces.push((first, i));
            pieces.push((i, last));
        }
    }
    points.iter().zip(kept).filter(|(_, kept)| *kept).map(|(point, _)| *point).collect()
}

fn distance_to_piece(p: At, a: At, b: At) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let squared = dx * dx + dy * dy;
    let part = if squared > 0.0 { ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / squared } else { 0.0 };
    let part = part.clamp(0.0, 1.0);
    (p[0] - a[0] - part * dx).hypot(p[1] - a[1] - part * dy)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Only points on the line between its ends are removed.
    #[test]
    fn a_line_keeps_its_corners_and_where_it_turns_back() {
        let straight = [[0.0, 0.0], [1.0, 0.019], [2.0, -0.019], [4.0, 0.0]];
        assert_eq!(simplified(&straight), [[0.0, 0.0], [4.0, 0.0]]);
        let corner = [[0.0, 0.0], [2.0, 0.03], [4.0, 0.0]];
        assert_eq!(simplified(&corner), corner);
        for end in [10.0, -10.0] {
            let back = [[0.0, 0.0], [end, 0.0], [0.5 * end, 0.0]];
            assert_eq!(simplified(&back), back);
        }
        let beyond = [[0.0, 0.0], [-5.0, 0.0], [5.0, 0.0]];
        assert_eq!(simplified(&beyond), beyond);
    }
}
