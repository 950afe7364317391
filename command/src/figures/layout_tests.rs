//! Defects that a referee would report: text that is cut off, too small, overlapping, or not in the font.

use resvg::usvg::{Group, Node};

use super::fixtures::{fixtures, of_scene};
use super::style::CENTIMETRE;
use super::{html, markup, png};

/// Points in a CSS pixel, the unit of a resolved SVG.
const POINTS: f32 = 0.75;

/// Texts with their boxes `[left, top, right, bottom]` in points, and their smallest letters.
fn texts(group: &Group, found: &mut Vec<(String, [f32; 4], f32)>) {
    for node in group.children() {
        match node {
            Node::Group(group) => texts(group, found),
            Node::Text(text) => {
                let b = text.abs_bounding_box();
                let letters: String = text.chunks().iter().map(|chunk| chunk.text()).collect();
                let sizes =
                    text.chunks().iter().flat_map(|chunk| chunk.spans().iter().map(|span| span.font_size().get()));
                let smallest = sizes.fold(f32::INFINITY, f32::min);
                found.push((letters, [b.left(), b.top(), b.right(), b.bottom()].map(|x| x * POINTS), smallest));
            }
            _ => {}
        }
    }
}

#[test]
fn text_is_whole_large_enough_and_apart() {
    let mut faults = Vec::new();
    for figure in fixtures() {
        let tree = png::tree(&figure.svg).unwrap();
        let (width, height) = (tree.size().width() * POINTS, tree.size().height() * POINTS);
        let columns = [8.6, 17.8].map(|centimetres| (centimetres * CENTIMETRE) as f32);
        assert!(columns.iter().any(|column| (column - width).abs() < 0.1), "{}: {width} pt wide", figure.name);
        let mut found = Vec::new();
        texts(tree.root(), &mut found);
        assert!(found.len() > 5, "{}: {} texts", figure.name, found.len());
        for (i, (text, b, size)) in found.iter().enumerate() {
            if *size < 7.0 {
                faults.push(format!("{}: `{text}` has letters of {size} pt", figure.name));
            }
            let inside = b[0] >= 0.0 && b[1] >= 0.0 && b[2] <= width && b[3] <= height;
            if !inside {
                faults.push(format!("{}: `{text}` at {b:.1?} is cut off", figure.name));
            }
            for (other, o, _) in &found[..i] {
                let apart = b[2] < o[0] + 0.5 || o[2] < b[0] + 0.5 || b[3] < o[1] + 0.5 || o[3] < b[1] + 0.5;
                if !apart {
                    faults.push(format!("{}: `{text}` at {b:.1?} is over `{other}` at {o:.1?}", figure.name));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_fonts_have_every_letter() {
    let ranges = include_str!("fonts/README.md").split("U+").skip(1).map(|rest| {
        let range: String = rest.chars().take_while(|c| c.is_ascii_hexdigit() || *c == '-').collect();
        let (first, last) = range.split_once('-').unwrap_or((&range, &range));
        u32::from_str_radix(first, 16).unwrap()..=u32::from_str_radix(last, 16).unwrap()
    });
    let ranges: Vec<_> = ranges.collect();
    for figure in fixtures() {
        let tree = png::tree(&figure.svg).unwrap();
        let mut found = Vec::new();
        texts(tree.root(), &mut found);
        for letter in found.iter().flat_map(|(text, _, _)| text.chars()) {
            let drawn = ranges.iter().any(|range| range.contains(&u32::from(letter)));
            assert!(drawn, "{}: the fonts have no `{letter}`", figure.name);
        }
    }
}

#[test]
fn data_are_numbers_in_columns_with_units() {
    for figure in fixtures() {
        assert!(!figure.tables.is_empty(), "{} has no data", figure.name);
        for table in &figure.tables {
            for column in &table.columns {
                let has_unit = column.ends_with(']') || column.contains('[');
                assert!(has_unit && !column.contains(','), "{}: `{column}`", figure.name);
            }
            for row in &table.rows {
                assert_eq!(row.len(), table.columns.len(), "{} {}", figure.name, table.name);
                assert!(row.iter().all(|x| x.is_finite()), "{} {}: {row:?}", figure.name, table.name);
            }
        }
        assert!(figure.caption.paragraphs().iter().all(|part| part.ends_with('.')), "{}", figure.name);
    }
}

#[test]
fn captions_close_their_marks() {
    for figure in fixtures() {
        for paragraph in figure.caption.paragraphs() {
            assert!(markup::is_balanced(paragraph), "{}: {paragraph}", figure.name);
            let html = html(paragraph);
            for tag in ["i", "b", "sub", "sup"] {
                let count = |mark: String| html.matches(&mark).count();
                assert_eq!(count(format!("<{tag}>")), count(format!("</{tag}>")), "{}: {html}", figure.name);
            }
            // Long bold or italic runs come from a misread mark.
            let longest = markup::runs(paragraph).into_iter().filter(|run| run.bold || run.italic);
            for run in longest {
                assert!(run.text.chars().count() < 8, "{}: `{}`", figure.name, run.text);
            }
        }
    }
}

#[test]
fn captions_name_what_is_drawn_and_nothing_else() {
    let (dashes, dots) = ("stroke-dasharray=\"5 2.5\"", "stroke-dasharray=\"1.2 1.8\"");
    let mut looked = 0;
    for figure in fixtures().filter(|figure| figure.name != "work-precision") {
        let caption = figure.caption.paragraphs().join(" ");
        let kinds: &[(&str, &str)] = match figure.name {
            name if name.starts_with("motion") => {
                &[("Eqs. (30)-(33) as printed", "perturbation, printed"), ("and corrected", "perturbation, corrected")]
            }
            "beam-alignment" => &[("thick stretches", "stroke-width=\"1.7\""), ("(dashed)", dashes)],
            "beam-alignment-spectra" => &[("Dashed:", dashes)],
            "pulse-series" => {
                &[("Solid curves", dashes), ("Dotted and dashed", dots), ("grey lines", "stroke=\"#8c8c8c\"")]
            }
            "wave-spectra" => &[("insets", "near 3"), ("(dotted)", dots), ("Dashed:", dashes)],
            _ => &[],
        };
        for (words, drawn) in kinds {
            assert_eq!(caption.contains(words), figure.svg.contains(drawn), "{}: `{words}`\n{caption}", figure.name);
            looked += 1;
        }
    }
    assert!(looked > 60, "{looked}");
}

/// A number without significant digits has no content: 0.00, or a ratio of 1 for a star that is not a sphere.
#[test]
fn captions_have_numbers_with_digits() {
    for figure in fixtures() {
        let caption = figure.caption.paragraphs().map(super::plain).join(" ");
        for number in caption.split(|c: char| !(c.is_ascii_digit() || c == '.')).map(|word| word.trim_matches('.')) {
            let is_lost = number.contains('.') && number.chars().all(|c| c == '0' || c == '.');
            assert!(!is_lost, "{}: {number} in\n{caption}", figure.name);
        }
        assert!(!caption.contains("Izz/Ixx = 1,") && !caption.contains("from 0 to 0"), "{}: {caption}", figure.name);
        assert!(!caption.contains("0 of the 0"), "{}: {caption}", figure.name);
    }
}

#[test]
fn physical_stars_are_drawn_in_si() {
    for figure in of_scene("b1828-11") {
        for column in figure.tables.iter().flat_map(|table| &table.columns) {
            assert!(!column.contains("t_c") && !column.contains("I^xx"), "{}: `{column}`", figure.name);
        }
        let texts = figure.caption.paragraphs().join(" ");
        assert!(texts.contains("time in s."), "{}: {texts}", figure.name);
        if let ("pulse-series", Some(table)) = (figure.name, figure.tables.first()) {
            // The value subtracted from the lengths is named on their axis as in the panel.
            let label = figure.svg.split("length − ").nth(1).expect("a label");
            assert!(label[..80].contains(">W<"), "{}", &label[..80]);
            // The period differs from 1 / F0 over ten years, but at the start by less than 1e-8.
            assert!((table.rows[0][1] * 2.468_871_714_7 - 1.0).abs() < 1e-7, "{:?}", table.rows[0]);
        }
    }
    let motion = &of_scene("tilted")[0].caption.says;
    assert!(
        motion.contains("its angles are those of the principal frame, which is not the frame of this file"),
        "{motion}"
    );
}
