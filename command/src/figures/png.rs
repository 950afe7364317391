//! The PNG of a figure, drawn from its SVG with fonts that are built into the program.

use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

/// Pixels per inch.
const RESOLUTION: f32 = 300.0;

/// CSS pixels per inch, the unit of an SVG's size.
const CSS_PIXELS: f32 = 96.0;

static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    for file in [
        &include_bytes!("fonts/Arimo-Regular.ttf")[..],
        include_bytes!("fonts/Arimo-Italic.ttf"),
        include_bytes!("fonts/Arimo-Bold.ttf"),
    ] {
        fonts.load_font_data(file.to_vec());
    }
    fonts.set_sans_serif_family("Arimo");
    Arc::new(fonts)
});

/// The SVG with its fonts resolved, as for drawing.
pub(super) fn tree(svg: &str) -> Result<Tree, String> {
    let options = Options { fontdb: FONTS.clone(), ..Options::default() };
    Tree::from_str(svg, &options).map_err(|error| format!("not SVG: {error}"))
}

/// The PNG of an SVG, at 300 pixels per inch.
pub fn png(svg: &str) -> Result<Vec<u8>, String> {
    let tree = tree(svg)?;
    let scale = RESOLUTION / CSS_PIXELS;
    let size = tree.size().to_int_size().scale_by(scale).ok_or("the picture has no size")?;
    let mut pixels = Pixmap::new(size.width(), size.height()).ok_or("the picture is too large")?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| format!("the picture cannot be coded: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 96 by 48 CSS pixels are one inch by half an inch. The left half is black.
    #[test]
    fn a_picture_has_300_pixels_each_inch() {
        let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" width="96" height="48"><rect x="0" y="0" width="48" height="48"/></svg>"#;
        let pixels = Pixmap::decode_png(&png(svg).unwrap()).unwrap();
        assert_eq!([pixels.width(), pixels.height()], [300, 150]);
        for (x, y, alpha) in [(0, 0, 255), (148, 148, 255), (151, 0, 0), (299, 149, 0)] {
            assert_eq!(pixels.pixel(x, y).map(|pixel| pixel.alpha()), Some(alpha), "{x} {y}");
        }
    }
}
