//! The paper's figures and ours: data, drawing and caption of each.
//!
//! A figure is made of a [`Recipe`]. Its SVG carries its text as text; the PNG is drawn from the same SVG. Everything that
//! a curve shows is in the figure's tables.

mod alignment;
mod alignment_spectra;
mod axes;
mod beam_cone;
mod bound_factor;
mod contour;
#[cfg(test)]
mod curve_tests;
#[cfg(test)]
mod data_tests;
#[cfg(test)]
mod drawn;
mod euler_angles;
mod examples;
mod golden;
#[cfg(test)]
mod layout_tests;
mod legend;
#[cfg(test)]
mod map_tests;
mod markup;
mod method_map;
mod momentum_sphere;
mod motion;
mod number;
mod parameters;
mod png;
mod pulse_series;
mod recipe;
mod regime_map;
mod scale;
mod spectrum;
mod sphere;
#[cfg(test)]
mod sphere_tests;
mod style;
mod subject;
mod svg;
mod table;
mod wave_spectra;
mod waves;
mod work_precision;

pub use examples::examples;
pub use golden::golden_tables;
pub use markup::{html, markdown, plain};
pub use png::png;
use rayon::prelude::*;
use recipe::Sheet;
pub use recipe::{OF_A_SCENE, RECIPES, Recipe};
pub use subject::{Shown, Subject};
pub use table::Table;
pub use work_precision::work_precision;

/// A figure: its drawing, its data and what there is to say about it.
#[derive(Debug, Clone)]
pub struct Figure {
    /// Name of its files, without endings.
    pub name: String,
    /// Number of the paper's figure, by order of appearance.
    pub paper_figure: Option<u8>,
    /// What it is, one line of plain text.
    pub summary: String,
    /// Caption, with the markup of [`markdown`], [`html`] and [`plain`].
    pub caption: Caption,
    /// The data.
    pub tables: Vec<Table>,
    /// The picture, a whole SVG document.
    pub svg: String,
}

/// What a caption says.
#[derive(Debug, Clone)]
pub struct Caption {
    /// What is shown.
    pub shows: String,
    /// With which parameters.
    pub parameters: String,
    /// By which method and equations.
    pub method: String,
    /// What the picture says.
    pub says: String,
}

impl Caption {
    /// The parts in order.
    pub fn paragraphs(&self) -> [&str; 4] {
        [&self.shows, &self.parameters, &self.method, &self.says]
    }
}

impl Figure {
    /// Name of the file of one of its tables.
    pub fn table_file(&self, table: &Table) -> String {
        if table.name.is_empty() { format!("{}.csv", self.name) } else { format!("{}.{}.csv", self.name, table.name) }
    }

    /// Summary, caption and data files as a page of Markdown.
    pub fn description(&self) -> String {
        let number = self.paper_figure.map_or(String::new(), |number| format!(" (Figure {number} of the paper)"));
        let mut page = format!("# {}{number}\n", self.summary);
        for paragraph in self.caption.paragraphs() {
            page += &format!("\n{}\n", markdown(paragraph));
        }
        let files: Vec<_> = self.tables.iter().map(|table| format!("`{}`", self.table_file(table))).collect();
        page + &format!("\nData: {}.\n", files.join(", "))
    }
}

/// All figures, drawn: the paper's in its order, then ours.
///
/// # Errors
/// If the data of one cannot be computed.
pub fn all() -> Result<Vec<Figure>, String> {
    let examples = examples()?;
    RECIPES.par_iter().map(|recipe| recipe.draw(&examples)).collect()
}

/// All of them, drawn once for the tests of this crate.
#[cfg(test)]
pub(crate) static DRAWN: std::sync::LazyLock<Vec<Figure>> = std::sync::LazyLock::new(|| all().expect("figures"));
