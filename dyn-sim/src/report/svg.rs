//! A small SVG writer: shapes with their style on them, text as text, nothing that leaks into a page around it.

use std::fmt::Write;

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stroke {
    pub(super) color: &'static str,
    pub(super) width: f64,
    /// SVG dash pattern; empty for a full line.
    pub(super) dash: &'static str,
}

impl Stroke {
    pub(super) const fn solid(color: &'static str, width: f64) -> Self {
        Self { color, width, dash: "" }
    }
}

/// How a text is set.
#[derive(Clone, Copy, Debug)]
pub(super) struct Font {
    pub(super) size: f64,
    pub(super) color: &'static str,
    /// `start`, `middle` or `end`.
    pub(super) anchor: &'static str,
    pub(super) bold: bool,
}

impl Font {
    pub(super) const fn new(size: f64, color: &'static str, anchor: &'static str) -> Self {
        Self { size, color, anchor, bold: false }
    }

    pub(super) const fn bold(self) -> Self {
        Self { bold: true, ..self }
    }
}

/// A drawing in pixels, y downwards.
pub(super) struct Svg {
    width: f64,
    height: f64,
    title: String,
    body: String,
}

impl Svg {
    /// An empty drawing; `title` is what a screen reader says.
    pub(super) fn new(width: f64, height: f64, title: &str) -> Self {
        Self { width, height, title: escape(title), body: String::new() }
    }

    fn element(&mut self, element: std::fmt::Arguments<'_>) {
        // Writing to a String cannot fail.
        let _ = writeln!(self.body, "{element}");
    }

    pub(super) fn line(&mut self, from: [f64; 2], to: [f64; 2], stroke: Stroke) {
        let ([x1, y1], [x2, y2]) = (from.map(px), to.map(px));
        let pen = pen(stroke);
        self.element(format_args!("<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\"{pen}/>"));
    }

    /// A line through all points; non-finite ones break it.
    pub(super) fn curve(&mut self, points: impl Iterator<Item = [f64; 2]>, stroke: Stroke) {
        let mut path = String::new();
        let mut lifted = true;
        for point in points {
            if point.iter().any(|coordinate| !coordinate.is_finite()) {
                lifted = true;
                continue;
            }
            path.push(if lifted { 'M' } else { 'L' });
            lifted = false;
            let _ = write!(path, "{} {}", px(point[0]), px(point[1]));
        }
        if !path.is_empty() {
            let pen = pen(stroke);
            self.element(format_args!("<path d=\"{path}\" fill=\"none\" stroke-linejoin=\"round\"{pen}/>"));
        }
    }

    /// Points by themselves, as thick as the stroke is wide; non-finite ones are left out.
    pub(super) fn dots(&mut self, points: impl Iterator<Item = [f64; 2]>, stroke: Stroke) {
        let mut path = String::new();
        for point in points.filter(|point| point.iter().all(|coordinate| coordinate.is_finite())) {
            let _ = write!(path, "M{} {}h0", px(point[0]), px(point[1]));
        }
        if !path.is_empty() {
            let pen = pen(stroke);
            self.element(format_args!("<path d=\"{path}\" fill=\"none\" stroke-linecap=\"round\"{pen}/>"));
        }
    }

    /// A closed outline; `fill` may be translucent.
    pub(super) fn polygon(&mut self, points: &[[f64; 2]], fill: &str, opacity: f64, stroke: Stroke) {
        let mut list = String::new();
        for [x, y] in points {
            let _ = write!(list, "{},{} ", px(*x), px(*y));
        }
        let (list, pen) = (list.trim_end(), pen(stroke));
        self.element(format_args!(
            "<polygon points=\"{list}\" fill=\"{fill}\" fill-opacity=\"{opacity}\"{pen}/>"
        ));
    }

    pub(super) fn rect(&mut self, corner: [f64; 2], size: [f64; 2], fill: &str, stroke: Stroke) {
        let ([x, y], [width, height], pen) = (corner.map(px), size.map(px), pen(stroke));
        self.element(format_args!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"{fill}\"{pen}/>"
        ));
    }

    pub(super) fn circle(&mut self, centre: [f64; 2], radius: f64, fill: &str, stroke: Stroke) {
        let ([x, y], radius, pen) = (centre.map(px), px(radius), pen(stroke));
        self.element(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"{fill}\"{pen}/>"));
    }

    pub(super) fn text(&mut self, at: [f64; 2], text: &str, font: Font) {
        let ([x, y], size, text) = (at.map(px), px(font.size), escape(text));
        let weight = if font.bold { " font-weight=\"600\"" } else { "" };
        let Font { color, anchor, .. } = font;
        self.element(format_args!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" fill=\"{color}\" text-anchor=\"{anchor}\"{weight}>{text}</text>"
        ));
    }

    /// For a page: no namespace, and as wide as its column.
    pub(super) fn inline(&self) -> String {
        self.wrapped("")
    }

    /// For a file of its own.
    pub(super) fn file(&self) -> String {
        let Self { width, height, .. } = self;
        self.wrapped(&format!(
            " xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\"",
            px(*width),
            px(*height)
        ))
    }

    fn wrapped(&self, attributes: &str) -> String {
        let Self { width, height, title, body } = self;
        let (width, height) = (px(*width), px(*height));
        format!(
            "<svg{attributes} viewBox=\"0 0 {width} {height}\" role=\"img\" \
             font-family=\"system-ui, 'Segoe UI', 'DejaVu Sans', Helvetica, Arial, sans-serif\">\n\
             <title>{title}</title>\n{body}</svg>\n"
        )
    }
}

fn pen(stroke: Stroke) -> String {
    let Stroke { color, width, dash } = stroke;
    if color == "none" || width == 0.0 {
        return String::new();
    }
    let dash = if dash.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dash}\"") };
    format!(" stroke=\"{color}\" stroke-width=\"{}\"{dash}", px(width))
}

/// No outline.
pub(super) const NO_STROKE: Stroke = Stroke::solid("none", 0.0);

/// A tenth of a pixel is enough; whole numbers go without a point.
fn px(value: f64) -> String {
    let text = format!("{:.1}", value + 0.0);
    match text.strip_suffix(".0") {
        Some("-0") => "0".to_owned(),
        Some(whole) => whole.to_owned(),
        None => text,
    }
}

/// Text safe in HTML and SVG, in attributes as well.
pub(super) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::expect;

    #[test]
    fn a_small_drawing() {
        let mut svg = Svg::new(80.0, 40.0, "a < b");
        svg.rect([0.0, 0.0], [80.0, 40.0], "#fff", NO_STROKE);
        svg.line([0.0, 20.0], [80.0, 20.04], Stroke { dash: "3 2", ..Stroke::solid("#999", 0.5) });
        svg.curve(
            [[0.0, 1.0], [1.0, 2.26], [f64::NAN, 0.0], [3.0, 4.0]].into_iter(),
            Stroke::solid("#000", 1.0),
        );
        svg.dots([[1.0, 2.0], [f64::INFINITY, 0.0], [3.0, 4.0]].into_iter(), Stroke::solid("#000", 3.0));
        svg.circle([5.0, 6.0], 2.5, "none", Stroke::solid("#000", 1.0));
        svg.polygon(&[[0.0, 0.0], [1.0, 0.0], [0.0, -0.04]], "#eee", 0.5, NO_STROKE);
        svg.text([4.0, 12.0], "R_b & \"s\"", Font::new(11.0, "#000", "middle").bold());
        expect![[r##"
            <svg xmlns="http://www.w3.org/2000/svg" width="80" height="40" viewBox="0 0 80 40" role="img" font-family="system-ui, 'Segoe UI', 'DejaVu Sans', Helvetica, Arial, sans-serif">
            <title>a &lt; b</title>
            <rect x="0" y="0" width="80" height="40" fill="#fff"/>
            <line x1="0" y1="20" x2="80" y2="20" stroke="#999" stroke-width="0.5" stroke-dasharray="3 2"/>
            <path d="M0 1L1 2.3M3 4" fill="none" stroke-linejoin="round" stroke="#000" stroke-width="1"/>
            <path d="M1 2h0M3 4h0" fill="none" stroke-linecap="round" stroke="#000" stroke-width="3"/>
            <circle cx="5" cy="6" r="2.5" fill="none" stroke="#000" stroke-width="1"/>
            <polygon points="0,0 1,0 0,0" fill="#eee" fill-opacity="0.5"/>
            <text x="4" y="12" font-size="11" fill="#000" text-anchor="middle" font-weight="600">R_b &amp; &quot;s&quot;</text>
            </svg>
        "##]].assert_eq(&svg.file());
        assert!(!svg.inline().contains("http"));
    }
}
