//! Sizes, colours and lines common to all figures. Lengths are in points, 1/72 inch.

/// Width of a column of the paper, 8.6 cm.
pub(super) const COLUMN: f64 = 8.6 * CENTIMETRE;

/// Width of both columns, 17.8 cm.
pub(super) const PAGE: f64 = 17.8 * CENTIMETRE;

/// Points in a centimetre.
pub(super) const CENTIMETRE: f64 = 72.0 / 2.54;

/// Size of axis labels and names.
pub(super) const LABEL: f64 = 9.0;

/// Size of numbers at ticks and of legends.
pub(super) const SMALL: f64 = 8.0;

/// Fonts of the SVG: the one used for the PNG, then fonts with the same widths.
pub(super) const FONTS: &str = "Arimo, 'Liberation Sans', Arial, Helvetica, sans-serif";

// Colours of Okabe and Ito, distinguishable without red-green vision. Line styles carry the same information.
pub(super) const BLACK: &str = "#000000";
pub(super) const GREY: &str = "#8c8c8c";
pub(super) const LIGHT: &str = "#c8c8c8";
pub(super) const ORANGE: &str = "#e69f00";
pub(super) const GREEN: &str = "#009e73";
pub(super) const BLUE: &str = "#0072b2";
pub(super) const VERMILION: &str = "#d55e00";
pub(super) const PURPLE: &str = "#cc79a7";

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line {
    pub(super) colour: &'static str,
    pub(super) width: f64,
    /// Lengths of dashes and gaps, none for a solid line.
    pub(super) dashes: &'static str,
}

pub(super) const fn solid(colour: &'static str, width: f64) -> Line {
    Line { colour, width, dashes: "" }
}

pub(super) const fn dashed(colour: &'static str, width: f64) -> Line {
    Line { colour, width, dashes: "5 2.5" }
}

pub(super) const fn dotted(colour: &'static str, width: f64) -> Line {
    Line { colour, width, dashes: "1.2 1.8" }
}

pub(super) const fn dash_dotted(colour: &'static str, width: f64) -> Line {
    Line { colour, width, dashes: "6 2 1.2 2" }
}
