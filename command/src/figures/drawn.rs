//! The visible content of a picture: its frames with axes, curves and marks as numbers, and its spheres.
//!
//! It is read from the text of the SVG alone: ticks and their numbers give the scale from the page to the numbers.

/// A line of the picture: stroke, width, dashes.
pub(super) type Style = (String, String, String);

pub(super) type Point = [f64; 2];

/// A line or a filled area, and the clipping region, if any.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Path {
    pub(super) points: Vec<Point>,
    pub(super) style: Style,
    pub(super) fill: String,
    pub(super) clip: Option<[f64; 4]>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Text {
    pub(super) at: Point,
    pub(super) words: String,
    pub(super) fill: String,
    pub(super) anchor: String,
    pub(super) turned: bool,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Element {
    Path(Path),
    Circle { at: Point, radius: f64, fill: String, stroke: String },
    Cell { corners: [f64; 4], fill: String },
    Text(Text),
}

pub(super) fn paths(elements: &[Element]) -> impl Iterator<Item = &Path> {
    elements.iter().filter_map(|element| if let Element::Path(path) = element { Some(path) } else { None })
}

pub(super) fn texts(elements: &[Element]) -> impl DoubleEndedIterator<Item = &Text> {
    elements.iter().filter_map(|element| if let Element::Text(text) = element { Some(text) } else { None })
}

/// Whether a rectangle `[left, top, right, bottom]` contains a point within `slack`.
pub(super) fn holds([left, top, right, bottom]: &[f64; 4], [x, y]: Point, slack: f64) -> bool {
    x > left - slack && x < right + slack && y > top - slack && y < bottom + slack
}

/// The elements in the order of drawing. The writer puts one on each line.
pub(super) fn elements(svg: &str) -> Vec<Element> {
    let (mut elements, mut clip, mut next) = (Vec::new(), None, None);
    for line in svg.lines().skip(2) {
        let text = |name: &str| {
            line.split_once(&format!(" {name}=\"")).map_or("", |(_, rest)| rest.split('"').next().unwrap_or(""))
        };
        let number = |name: &str| text(name).parse::<f64>().unwrap_or_else(|_| panic!("no {name} in {line}"));
        let rectangle = || {
            let [x, y, width, height] = ["x", "y", "width", "height"].map(number);
            [x, y, x + width, y + height]
        };
        if line.starts_with("<clipPath") {
            next = Some(rectangle());
        } else if line.starts_with("<g ") {
            clip = next;
        } else if line.starts_with("</g>") {
            clip = None;
        } else if line.starts_with("<path") {
            let points = text("d").trim_end_matches('Z').split(['M', 'L']).skip(1);
            let point = |pair: &str| {
                let (x, y) = pair.split_once(' ').expect("two numbers");
                [x, y].map(|x| x.parse().expect("a number"))
            };
            let style = (text("stroke").into(), text("stroke-width").into(), text("stroke-dasharray").into());
            let points = points.map(point).collect();
            elements.push(Element::Path(Path { points, style, fill: text("fill").into(), clip }));
        } else if line.starts_with("<circle") {
            let at = [number("cx"), number("cy")];
            let [fill, stroke] = ["fill", "stroke"].map(|name| text(name).to_owned());
            elements.push(Element::Circle { at, radius: number("r"), fill, stroke });
        } else if line.starts_with("<rect x") {
            elements.push(Element::Cell { corners: rectangle(), fill: text("fill").into() });
        } else if line.starts_with("<text") {
            let at = [number("x"), number("y")];
            let turned = line.contains("rotate(-90");
            let (fill, anchor) = (text("fill").to_owned(), text("text-anchor").to_owned());
            elements.push(Element::Text(Text { at, words: words(line), fill, anchor, turned }));
        }
    }
    elements
}

/// The words of a text element, with `_` and `^` before subscripts and superscripts.
fn words(line: &str) -> String {
    let (_, inner) = line.split_once('>').expect("an element");
    let inner = inner.strip_suffix("</text>").expect("an end");
    let (mut words, mut shift) = (String::new(), 0.0);
    for piece in inner.split("</tspan>") {
        let (before, span) = piece.split_once("<tspan").unwrap_or((piece, ""));
        words += before;
        if let Some((attributes, text)) = span.split_once('>') {
            if let Some((_, dy)) = attributes.split_once(" dy=\"") {
                shift += dy.split('"').next().and_then(|dy| dy.parse::<f64>().ok()).expect("a shift");
                // A downward shift is a subscript; the shifts are rounded to 0.01.
                words += if shift > 0.1 {
                    "_"
                } else if shift < -0.1 {
                    "^"
                } else {
                    ""
                };
            }
            words += text;
        }
    }
    words.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&")
}

/// A number at a tick or in a panel, `−0.5`, `10^−3` or `1.5 × 10^−3`.
pub(super) fn number(words: &str) -> Option<f64> {
    let words = words.replace('\u{2212}', "-");
    let (factor, power) = words.split_once(" × ").unwrap_or(("1", &words));
    match power.strip_prefix("10^") {
        Some(power) => Some(factor.parse::<f64>().ok()? * 10f64.powi(power.parse().ok()?)),
        None => power.parse().ok(),
    }
}

/// An axis: its label and its scale from the page to the numbers.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Scale {
    pub(super) label: String,
    logarithmic: bool,
    /// Two ticks: place on the page and number.
    ends: [(f64, f64); 2],
}

impl Scale {
    /// The place of a number on the page.
    pub(super) fn place(&self, value: f64) -> f64 {
        let [(p, a), (q, b)] = self.ends;
        let of = |x: f64| if self.logarithmic { x.log10() } else { x };
        p + (of(value) - of(a)) / (of(b) - of(a)) * (q - p)
    }

    /// The number at a place of the page.
    pub(super) fn value(&self, place: f64) -> f64 {
        let [(p, a), (q, b)] = self.ends;
        let part = (place - p) / (q - p);
        if self.logarithmic { a * (b / a).powf(part) } else { a + (b - a) * part }
    }

    /// Scale through ticks `(place, number)`, which must all fit; `None` for fewer than two.
    fn through(label: String, ticks: &[(f64, String)]) -> Option<Self> {
        let (first, last) = (ticks.first()?, ticks.last()?);
        let logarithmic = ticks.iter().all(|(_, number)| number.starts_with("10^"));
        // `[10^{3} s]` or ` / 10^{3}` in the label: the factor missing from the numbers.
        let (label, power) = taken_out(label);
        let of = |tick: &(f64, String)| Some((tick.0, number(&tick.1)? * power));
        let scale = Self { label, logarithmic, ends: [of(first)?, of(last)?] };
        for (place, value) in ticks.iter().map(|tick| of(tick).expect("a number at a tick")) {
            let off = scale.place(value) - place;
            assert!(off.abs() < 0.02, "{scale:?}: the tick {value} is off by {off} pt");
        }
        (ticks.len() > 1).then_some(scale)
    }
}

fn taken_out(label: String) -> (String, f64) {
    let Some((before, rest)) = label.split_once("10^") else { return (label, 1.0) };
    let end = rest.find([' ', ']']).unwrap_or(rest.len());
    let power = number(&format!("10^{}", &rest[..end])).expect("a power");
    let rest = rest[end..].trim_start();
    let before = if rest.is_empty() { before.strip_suffix(" / ").unwrap_or(before) } else { before };
    (format!("{before}{rest}").trim_end_matches(" []").to_owned(), power)
}

/// A frame with its content.
#[derive(Debug, Clone, Default)]
pub(super) struct Frame {
    pub(super) corners: [f64; 4],
    pub(super) x: Scale,
    pub(super) y: Scale,
    /// The heading above its column, without the letter.
    pub(super) heading: String,
    /// Curves with the same line, in order of drawing.
    pub(super) curves: Vec<(Style, Vec<Vec<Point>>)>,
    /// Centres of small circles.
    pub(super) marks: Vec<(String, Vec<Point>)>,
    /// Straight lines from side to side: heights of horizontal ones and abscissas of vertical ones, as numbers.
    pub(super) levels: Vec<f64>,
    pub(super) uprights: Vec<f64>,
    /// Words inside.
    pub(super) remarks: Vec<String>,
}

impl Path {
    /// Whether this frame clips it.
    fn is_within(&self, corners: &[f64; 4]) -> bool {
        self.clip.is_some_and(|clip| clip.iter().zip(corners).all(|(a, b)| near(*a, *b)))
    }
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 0.03
}

/// The frames of a picture in order of drawing; an axis without numbers shares those of the frame below or to the left.
pub(super) fn frames(elements: &[Element]) -> Vec<Frame> {
    // A closed line around something with ticks; other boxes have no numbers beside them.
    let closed = paths(elements)
        .filter(|Path { points, fill, .. }| points.len() == 5 && points[0] == points[4] && fill == "none");
    let corners = closed.map(|Path { points, .. }| [points[0][0], points[0][1], points[2][0], points[2][1]]);
    let corners: Vec<_> = corners.filter(|c| c[2] - c[0] > 30.0 && c[3] - c[1] > 30.0).collect();
    let own: Vec<_> = corners.iter().map(|c| scales(elements, c)).collect();
    let is_inside = |c: &[f64; 4], o: &[f64; 4]| c != o && c[0] > o[0] && c[1] > o[1] && c[2] < o[2] && c[3] < o[3];
    let frame = |(i, c): (usize, &[f64; 4])| {
        let is_empty = !paths(elements).any(|path| path.is_within(c));
        let outer = corners.iter().position(|o| is_inside(c, o));
        let like = |same: &dyn Fn(&[f64; 4]) -> bool, axis: usize| {
            (0..corners.len()).filter(|&j| same(&corners[j])).find_map(|j| own[j][axis].clone())
        };
        let x = own[i][0].clone().or_else(|| like(&|o| near(o[0], c[0]) && near(o[2], c[2]), 0));
        let y = own[i][1].clone().or_else(|| like(&|o| near(o[1], c[1]) && near(o[3], c[3]), 1));
        let (Some(mut x), Some(mut y)) = (x, y) else {
            assert!(is_empty, "curves in the frame {c:?}, of which an axis has no numbers");
            return None;
        };
        if let Some(outer) = outer {
            // The frame around an inset names its quantities, the words above it the powers of ten.
            let above = texts(elements).rfind(|text| near(text.at[0], c[2]) && near(text.at[1], c[1] - 4.0));
            let (_, power) = taken_out(above.map_or(String::new(), |text| text.words.clone()));
            y.ends = y.ends.map(|(place, value)| (place, value * power));
            let shared = |axis: usize| {
                own[outer][axis].clone().or_else(|| {
                    let below = (0..corners.len()).filter(|&j| near(corners[j][0], corners[outer][0]));
                    below.filter_map(|j| own[j][axis].clone()).next_back()
                })
            };
            (x.label, y.label) = (shared(0).expect("a label").label, shared(1).expect("a label").label);
        }
        if x.label.is_empty() {
            x.label = like(&|o| near(o[0], c[0]) && o[1] > c[1], 0).expect("a frame below").label;
        }
        let left = corners[outer.unwrap_or(i)][0];
        let is_heading =
            |text: &&Text| !text.turned && text.anchor.is_empty() && near(text.at[0], left) && text.at[1] < c[1];
        let heading = texts(elements).rfind(is_heading).map_or(String::new(), |text| text.words.clone());
        let heading = match heading.split_once(") ") {
            Some((letter, rest)) if letter.starts_with('(') && letter.len() == 2 => rest.to_owned(),
            _ if heading.starts_with('(') && heading.len() == 3 => String::new(),
            _ => heading,
        };
        let mut frame = Frame { corners: *c, x, y, heading, ..Frame::default() };
        fill(&mut frame, elements, &corners.iter().copied().filter(|o| is_inside(o, c)).collect::<Vec<_>>());
        Some(frame)
    };
    corners.iter().enumerate().filter_map(frame).collect()
}

/// The axes of a frame that have their own numbers.
fn scales(elements: &[Element], &[left, top, right, bottom]: &[f64; 4]) -> [Option<Scale>; 2] {
    let (mut ticks, mut labels) = ([Vec::new(), Vec::new()], [String::new(), String::new()]);
    let marked = |place: f64, axis: usize| {
        paths(elements).any(|path| match (axis, &path.points[..]) {
            (0, [a, b]) => near(a[0], place) && near(b[0], place) && near(a[1], bottom) && near(b[1], bottom - 3.5),
            (_, [a, b]) => near(a[1], place) && near(b[1], place) && near(a[0], left) && near(b[0], left + 3.5),
            _ => false,
        })
    };
    for Text { at: [x, y], words, anchor, turned, .. } in texts(elements) {
        let (across, along) = (*x > left - 0.1 && *x < right + 0.1, *y > top && *y < bottom + 4.0);
        if anchor == "middle" && across && near(*y, bottom + 11.5) && marked(*x, 0) {
            ticks[0].push((*x, words.clone()));
        } else if anchor == "middle" && near(*x, (left + right) / 2.0) && near(*y, bottom + 23.0) {
            labels[0] = words.clone();
        } else if *turned && near(*y, (top + bottom) / 2.0) && *x < left && left - *x < 60.0 {
            labels[1] = words.clone();
        } else if anchor == "end" && near(*x, left - 3.0) && along {
            // The tick is at the middle of a digit.
            let place = y - 2.8;
            assert!(marked(place, 1), "no tick at the number {words}");
            ticks[1].push((place, words.clone()));
        }
    }
    [0, 1].map(|axis| Scale::through(std::mem::take(&mut labels[axis]), &ticks[axis]))
}

fn fill(frame: &mut Frame, elements: &[Element], insets: &[[f64; 4]]) {
    let [left, top, right, bottom] = frame.corners;
    let is_within = |at: Point, c: &[f64; 4]| holds(&[c[0], c[1] - 13.0, c[2], c[3] + 11.0], at, 3.0);
    for element in elements {
        match element {
            Element::Path(path @ Path { points, style, .. }) if path.is_within(&frame.corners) => {
                match frame.curves.iter_mut().find(|(known, _)| known == style) {
                    Some((_, pieces)) => pieces.push(points.clone()),
                    None => frame.curves.push((style.clone(), vec![points.clone()])),
                }
            }
            Element::Path(Path { points, style, clip: None, .. }) if points.len() == 2 && style.1 != "0.6" => {
                let [a, b] = [points[0], points[1]];
                if near(a[0], left) && near(b[0], right) && near(a[1], b[1]) && a[1] > top && a[1] < bottom {
                    frame.levels.push(frame.y.value(a[1]));
                } else if near(a[0], b[0]) && near(a[1], bottom) && near(b[1], top) && a[0] > left && a[0] < right {
                    frame.uprights.push(frame.x.value(a[0]));
                }
            }
            Element::Circle { at, radius, fill, stroke } if *radius < 2.0 && holds(&frame.corners, *at, 0.1) => {
                let colour = if stroke.is_empty() { fill } else { stroke };
                match frame.marks.iter_mut().find(|(known, _)| known == colour) {
                    Some((_, places)) => places.push(*at),
                    None => frame.marks.push((colour.clone(), vec![*at])),
                }
            }
            Element::Text(Text { at, words, .. })
                if holds(&[left, top, right + 20.0, bottom], *at, 0.0) && !insets.iter().any(|c| is_within(*at, c)) =>
            {
                frame.remarks.push(words.clone());
            }
            _ => {}
        }
    }
}

type Named<T> = Vec<(T, String)>;

/// The names beside sample lines and marks: by line, or by the colour of a mark.
pub(super) fn legend(elements: &[Element]) -> (Named<Style>, Named<String>) {
    let (mut lines, mut marks) = (Vec::new(), Vec::new());
    for pair in elements.windows(2) {
        let Element::Text(Text { at: [x, y], words, .. }) = &pair[1] else { continue };
        match &pair[0] {
            Element::Path(Path { points, style, .. })
                if points.len() == 2
                    && near(points[1][0] - points[0][0], 20.0)
                    && near(*x, points[1][0] + 4.0)
                    && near(*y, points[0][1] + 2.8) =>
            {
                lines.push((style.clone(), words.clone()));
            }
            Element::Circle { at, radius, fill, .. } if near(*radius, 2.0) && near(*x, at[0] + 14.0) => {
                marks.push((fill.clone(), words.clone()));
            }
            _ => {}
        }
    }
    (lines, marks)
}

/// A picture of the sphere: places of the origin and of the heads of three unit axes on the page.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ball {
    pub(super) origin: Point,
    axes: [Point; 3],
}

impl Ball {
    /// From three arrows with these names and lengths.
    pub(super) fn of(elements: &[Element], names: [&str; 3], lengths: [f64; 3]) -> Option<Self> {
        let arrows = arrows(elements);
        let find = |name: &str| arrows.iter().find(|(found, ..)| found == name);
        // The dashed part of an axis inside the sphere begins at the origin, as does an arrow without a dashed part.
        let is_dashed = |path: &&Path| path.points.len() == 2 && path.style.0 == "#8c8c8c" && path.style.1 == "0.6";
        let first = paths(elements).find(is_dashed).map(|path| path.points[0]);
        let origin = first.or_else(|| find(names[0]).map(|(_, from, _)| *from))?;
        let [x, y, z] = names.map(|name| find(name).map(|(_, _, head)| *head));
        let part = |head: Point, length: f64| [0, 1].map(|i| (head[i] - origin[i]) / length);
        Some(Self { origin, axes: [part(x?, lengths[0]), part(y?, lengths[1]), part(z?, lengths[2])] })
    }

    /// The place of the head of a vector on the page.
    pub(super) fn place(&self, v: [f64; 3]) -> Point {
        [0, 1].map(|i| self.origin[i] + (0..3).map(|k| v[k] * self.axes[k][i]).sum::<f64>())
    }

    /// Positive if the head of a vector is on the side of the eye: along the normal of the page in a right-handed frame, y downwards.
    pub(super) fn towards(&self, v: [f64; 3]) -> f64 {
        let (right, up) = (self.axes.map(|axis| axis[0]), self.axes.map(|axis| -axis[1]));
        let normal = [0, 1, 2].map(|i| right[(i + 1) % 3] * up[(i + 2) % 3] - right[(i + 2) % 3] * up[(i + 1) % 3]);
        let size = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        (0..3).map(|i| v[i] * normal[i]).sum::<f64>() / size
    }
}

/// Arrows with the name that follows each: its start and its head.
pub(super) fn arrows(elements: &[Element]) -> Vec<(String, Point, Point)> {
    let mut arrows = Vec::new();
    for (i, three) in elements.windows(2).enumerate() {
        let [Element::Path(shaft), Element::Path(head)] = three else { continue };
        let name = texts(&elements[i + 2..]).next().map_or(String::new(), |text| text.words.clone());
        if shaft.points.len() == 2 && head.points.len() == 4 && head.fill != "none" {
            arrows.push((name, shaft.points[0], head.points[0]));
        }
    }
    arrows
}
