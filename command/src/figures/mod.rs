//! The paper's figures and ours: data, drawing and caption of each.
//!
//! A figure is made from a `Recipe`. Its SVG contains its text as text; the PNG is drawn from the same SVG. All data of
//! a curve are in the figure's tables.

mod alignment;
mod alignment_spectra;
mod axes;
mod beam_cone;
mod bound_factor;
mod caption;
#[cfg(test)]
mod caption_tests;
mod contour;
#[cfg(test)]
mod curve_tests;
#[cfg(test)]
mod data_tests;
mod drawing;
#[cfg(test)]
mod drawn;
mod euler_angles;
mod examples;
#[cfg(test)]
pub(crate) mod fixtures;
mod golden;
#[cfg(test)]
mod layout_tests;
mod legend;
mod line_atlas;
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
mod readme;
mod recipe;
mod regime_map;
mod residuals;
mod scale;
mod spectrum;
mod sphere;
#[cfg(test)]
mod sphere_tests;
mod spin_down;
#[cfg(test)]
mod spin_down_tests;
#[cfg(test)]
mod statement_tests;
mod style;
mod subject;
mod svg;
mod table;
mod violation_residuals;
mod wave_spectra;
mod waves;
mod work_precision;

pub(crate) use caption::Caption;
pub(crate) use examples::examples;
pub use golden::golden_tables;
pub(crate) use markup::{html, literal, markdown, plain};
pub(crate) use png::png;
use rayon::prelude::*;
pub use readme::readme_picture;
pub(crate) use recipe::{OF_A_SCENE, RECIPES, Recipe};
pub(crate) use residuals::residuals;
pub(crate) use subject::Subject;
pub(crate) use table::Table;
pub(crate) use work_precision::work_precision;

/// A figure: its drawing, its data and its description.
#[derive(Debug, Clone)]
pub struct Figure {
    pub(crate) name: String,
    /// Number of the paper's figure, by order of appearance.
    pub(crate) paper_figure: Option<u8>,
    pub(crate) summary: String,
    /// Caption, with the markup of [`markdown`], [`html`] and [`plain`].
    pub(crate) caption: Caption,
    pub(crate) tables: Vec<Table>,
    /// The picture as a complete SVG document.
    pub(crate) svg: String,
}

impl Figure {
    pub(crate) fn table_file(&self, table: &Table) -> String {
        if table.name.is_empty() { format!("{}.csv", self.name) } else { format!("{}.{}.csv", self.name, table.name) }
    }

    /// Summary, caption and data files as a page of Markdown.
    pub(crate) fn description(&self) -> String {
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
pub fn all() -> Result<Vec<Figure>, String> {
    let examples = examples()?;
    RECIPES.par_iter().map(|recipe| recipe.draw(&examples)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_description_has_the_summary_the_caption_and_the_files() {
        let [shows, parameters, method, says] = ["*A*.", "B_{0}.", "C.", "D."].map(str::to_owned);
        let tables = ["", "more"].map(|name| Table::new(name, ["t [s]"])).to_vec();
        let caption = Caption { shows, parameters, method, says };
        let figure = |paper_figure| Figure {
            name: "waves".into(),
            paper_figure,
            summary: "Waves".into(),
            caption: caption.clone(),
            tables: tables.clone(),
            svg: String::new(),
        };
        let rest = "\n\n*A*.\n\nB<sub>0</sub>.\n\nC.\n\nD.\n\nData: `waves.csv`, `waves.more.csv`.\n";
        assert_eq!(figure(None).description(), format!("# Waves{rest}"));
        assert_eq!(figure(Some(11)).description(), format!("# Waves (Figure 11 of the paper){rest}"));
    }
}
