//! A figure: two columns of three panels on a common horizontal axis, drawn as SVG.

use super::axis::{extent, fixed, linear_ticks, log_ticks, padded, power_of_ten, prefix};
use super::decimate::decimate;
use super::svg::{Font, NO_STROKE, Stroke, Svg};

/// One line in a panel.
pub(super) struct Curve {
    /// Index into the figure's [`Figure::legend`].
    pub(super) entry: usize,
    /// Ascending.
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
    /// Points by themselves instead of a line through them; all are drawn.
    pub(super) dots: bool,
}

/// One frame with its curves.
pub(super) struct Panel {
    pub(super) label: String,
    pub(super) curves: Vec<Curve>,
}

/// Panels one above the other that share unit and vertical axis, also with columns of the same heading.
pub(super) struct Column {
    pub(super) heading: &'static str,
    /// Unit without prefix.
    pub(super) unit: &'static str,
    pub(super) panels: Vec<Panel>,
}

/// The vertical axis.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Scale {
    Linear,
    /// Down to this fraction of the largest value; what lies below runs along the edge.
    Logarithmic {
        floor: f64,
    },
}

/// Everything to be drawn, and the words around it.
pub(super) struct Figure {
    /// File name without extension.
    pub(super) name: String,
    pub(super) title: String,
    /// What to see in it, in a sentence or two.
    pub(super) caption: String,
    pub(super) x_label: String,
    /// What of the horizontal axis is shown.
    pub(super) x_range: [f64; 2],
    pub(super) scale: Scale,
    pub(super) columns: Vec<Column>,
    pub(super) legend: Vec<(String, Stroke)>,
    /// Where vertical lines stand, and what is written over them.
    pub(super) marks: Vec<(f64, String)>,
}

const WIDTH: f64 = 1000.0;
const LEFT: f64 = 58.0;
const GUTTER: f64 = 74.0;
const RIGHT: f64 = 20.0;
/// Above each panel, for its label.
const GAP: f64 = 24.0;
const GRID: Stroke = Stroke::solid("#e7e9ee", 1.0);
const FRAME: Stroke = Stroke::solid("#9aa3b2", 1.0);
const MARK: Stroke = Stroke { color: "#b08400", width: 1.0, dash: "2 3" };
const TICK: Font = Font::new(11.5, "#454c5a", "end");
const TEXT: Font = Font::new(13.0, "#1c2230", "start");

/// Position and scale of one panel.
struct Frame {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
    x: [f64; 2],
    y: [f64; 2],
    logarithmic: bool,
}

impl Frame {
    fn across(&self, x: f64) -> f64 {
        self.left + self.width * (x - self.x[0]) / (self.x[1] - self.x[0])
    }

    /// About how many ticks have room for their labels.
    fn ticks_across(&self) -> usize {
        if self.width < 350.0 { 2 } else { 5 }
    }

    fn down(&self, y: f64) -> f64 {
        let share = if self.logarithmic {
            // Values below the floor, zero included, run along the lower edge.
            (y.max(self.y[0]) / self.y[0]).ln() / (self.y[1] / self.y[0]).ln()
        } else {
            (y - self.y[0]) / (self.y[1] - self.y[0])
        };
        self.top + self.height * (1.0 - share)
    }
}

impl Figure {
    /// Every value shown in a column and in others of the same heading: inside the horizontal range.
    fn shown<'a>(&'a self, column: &'a Column) -> impl Iterator<Item = f64> + 'a {
        let [from, to] = self.x_range;
        let slack = 1e-9 * (to - from);
        let alike = self.columns.iter().filter(|other| other.heading == column.heading);
        let panels = alike.flat_map(|column| &column.panels);
        panels.flat_map(|panel| &panel.curves).flat_map(move |curve| {
            let inside = move |x: f64| x >= from - slack && x <= to + slack;
            curve.x.iter().zip(&curve.y).filter(move |(x, _)| inside(**x)).map(|(_, y)| *y)
        })
    }

    /// Vertical range, and prefix with its factor, of one column.
    fn vertical(&self, column: &Column) -> ([f64; 2], &'static str, f64) {
        let range = extent(self.shown(column)).unwrap_or([0.0, 0.0]);
        match self.scale {
            Scale::Linear => {
                let (symbol, factor) = prefix(range[0].abs().max(range[1].abs()));
                (padded(range), symbol, factor)
            }
            Scale::Logarithmic { floor } => {
                let top = if range[1] > 0.0 { range[1] } else { 1.0 };
                // A whole decade at the bottom, and room for the peak at the top.
                ([10f64.powf((top * floor).log10().floor()), 3.0 * top], "", 1.0)
            }
        }
    }

    /// Draws it.
    pub(super) fn draw(&self) -> Svg {
        let rows = self.columns.iter().map(|column| column.panels.len()).max().unwrap_or(0);
        let logarithmic = self.scale != Scale::Linear;
        let panel_height = if logarithmic { 160.0 } else { 116.0 };
        // A single line needs no legend: the title names it.
        let heading = if self.legend.len() > 1 { 42.0 } else { 16.0 };
        let top = heading + GAP + 4.0;
        let bottom = top + rows as f64 * (panel_height + GAP) - GAP;
        let mut svg = Svg::new(WIDTH, bottom + 46.0, &self.title);
        svg.rect([0.0, 0.0], [WIDTH, bottom + 46.0], "#ffffff", NO_STROKE);
        if self.legend.len() > 1 {
            self.draw_legend(&mut svg);
        }
        let count = self.columns.len().max(1) as f64;
        let width = (WIDTH - LEFT - RIGHT - (count - 1.0) * GUTTER) / count;
        for (column, index) in self.columns.iter().zip(0u8..) {
            let left = LEFT + f64::from(index) * (width + GUTTER);
            let (y, symbol, factor) = self.vertical(column);
            svg.text([left, heading], &format!("{}, {symbol}{}", column.heading, column.unit), TEXT);
            let mut frame = Frame { left, top, width, height: panel_height, x: self.x_range, y, logarithmic };
            for (panel, number) in column.panels.iter().zip(1..) {
                self.draw_panel(&mut svg, &frame, panel, factor);
                if number == 1 {
                    self.draw_marks(&mut svg, &frame, bottom, &panel.label);
                }
                if number == column.panels.len() {
                    self.draw_x_axis(&mut svg, &frame);
                }
                frame.top += panel_height + GAP;
            }
        }
        svg
    }

    fn draw_legend(&self, svg: &mut Svg) {
        let mut x = LEFT;
        for (label, stroke) in &self.legend {
            svg.line([x, 14.0], [x + 26.0, 14.0], *stroke);
            svg.text([x + 32.0, 18.5], label, TEXT);
            x += 60.0 + 7.2 * label.chars().count() as f64;
        }
    }

    fn draw_panel(&self, svg: &mut Svg, frame: &Frame, panel: &Panel, factor: f64) {
        let Frame { left, top, width, height, .. } = *frame;
        let level = |svg: &mut Svg, y: f64, label: &str| {
            let down = frame.down(y);
            svg.line([left, down], [left + width, down], GRID);
            svg.text([left - 6.0, down + 4.0], label, TICK);
        };
        if frame.logarithmic {
            for tick in log_ticks(frame.y, 6) {
                level(svg, tick, &power_of_ten(tick.log10().round() as i32));
            }
        } else {
            let (ticks, decimals) = linear_ticks(frame.y.map(|y| y / factor), 3);
            for tick in ticks {
                level(svg, tick * factor, &fixed(tick, decimals));
            }
        }
        for tick in linear_ticks(frame.x, frame.ticks_across()).0 {
            let across = frame.across(tick);
            svg.line([across, top], [across, top + height], GRID);
        }
        for curve in &panel.curves {
            if curve.dots {
                let points = curve.x.iter().zip(&curve.y).map(|(x, y)| [frame.across(*x), frame.down(*y)]);
                svg.dots(points, self.legend[curve.entry].1);
                continue;
            }
            let kept = decimate(&curve.x, &curve.y, frame.x, width as usize);
            let points = kept.into_iter().map(|i| [frame.across(curve.x[i]), frame.down(curve.y[i])]);
            svg.curve(points, self.legend[curve.entry].1);
        }
        svg.rect([left, top], [width, height], "none", FRAME);
        svg.text([left, top - 6.0], &panel.label, TEXT.bold());
    }

    /// Vertical lines through all panels of a column, their labels over the first, beside its own label.
    fn draw_marks(&self, svg: &mut Svg, frame: &Frame, bottom: f64, panel_label: &str) {
        let mut free_from = frame.left + 9.0 * panel_label.chars().count() as f64;
        for (x, label) in &self.marks {
            if *x < frame.x[0] || *x > frame.x[1] {
                continue;
            }
            let across = frame.across(*x);
            svg.line([across, frame.top], [across, bottom], MARK);
            let half = 3.6 * label.chars().count() as f64;
            if across - half > free_from {
                svg.text([across, frame.top - 6.0], label, Font::new(11.5, "#7a5c00", "middle"));
                free_from = across + half;
            }
        }
    }

    fn draw_x_axis(&self, svg: &mut Svg, frame: &Frame) {
        let below = frame.top + frame.height;
        let (ticks, decimals) = linear_ticks(frame.x, frame.ticks_across());
        for tick in ticks {
            let at = [frame.across(tick), below + 16.0];
            svg.text(at, &fixed(tick, decimals), Font { anchor: "middle", ..TICK });
        }
        let middle = frame.left + frame.width / 2.0;
        svg.text([middle, below + 35.0], &self.x_label, Font { anchor: "middle", ..TEXT });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::expect;

    #[test]
    fn a_figure_of_two_panels() {
        let curve = |y: [f64; 3]| Curve { entry: 0, x: vec![0.0, 0.5, 1.0], y: y.into(), dots: false };
        let column = |heading, y| Column {
            heading,
            unit: "N",
            panels: vec![Panel { label: "leg 1".into(), curves: vec![curve(y)] }],
        };
        let figure = Figure {
            name: "force".into(),
            title: "Forces".into(),
            caption: String::new(),
            x_label: "time, s".into(),
            x_range: [0.0, 1.0],
            scale: Scale::Linear,
            columns: vec![column("left", [0.0, 2e-3, -2e-3]), column("right", [1.0, f64::NAN, 1.0])],
            legend: vec![("force".into(), Stroke::solid("#0b5cad", 1.5))],
            marks: vec![(0.5, "middle".into()), (0.51, "too near".into()), (7.0, "outside".into())],
        };
        expect![[r##"
            <svg xmlns="http://www.w3.org/2000/svg" width="1000" height="206" viewBox="0 0 1000 206" role="img" font-family="system-ui, 'Segoe UI', 'DejaVu Sans', Helvetica, Arial, sans-serif">
            <title>Forces</title>
            <rect x="0" y="0" width="1000" height="206" fill="#ffffff"/>
            <text x="58" y="16" font-size="13" fill="#1c2230" text-anchor="start">left, mN</text>
            <line x1="58" y1="152" x2="482" y2="152" stroke="#e7e9ee" stroke-width="1"/>
            <text x="52" y="156" font-size="11.5" fill="#454c5a" text-anchor="end">−2</text>
            <line x1="58" y1="127" x2="482" y2="127" stroke="#e7e9ee" stroke-width="1"/>
            <text x="52" y="131" font-size="11.5" fill="#454c5a" text-anchor="end">−1</text>
            <line x1="58" y1="102" x2="482" y2="102" stroke="#e7e9ee" stroke-width="1"/>
            <text x="52" y="106" font-size="11.5" fill="#454c5a" text-anchor="end">0</text>
            <line x1="58" y1="77" x2="482" y2="77" stroke="#e7e9ee" stroke-width="1"/>
            <text x="52" y="81" font-size="11.5" fill="#454c5a" text-anchor="end">1</text>
            <line x1="58" y1="52" x2="482" y2="52" stroke="#e7e9ee" stroke-width="1"/>
            <text x="52" y="56" font-size="11.5" fill="#454c5a" text-anchor="end">2</text>
            <line x1="58" y1="44" x2="58" y2="160" stroke="#e7e9ee" stroke-width="1"/>
            <line x1="142.8" y1="44" x2="142.8" y2="160" stroke="#e7e9ee" stroke-width="1"/>
            <line x1="227.6" y1="44" x2="227.6" y2="160" stroke="#e7e9ee" stroke-width="1"/>
            <line x1="312.4" y1="44" x2="312.4" y2="160" stroke="#e7e9ee" stroke-width="1"/>
            <line x1="397.2" y1="44" x2="397.2" y2="160" stroke="#e7e9ee" stroke-width="1"/>
            <line x1="482" y1="44" x2="482" y2="160" stroke="#e7e9ee" stroke-width="1"/>
            <path d="M58 102L270 52L482 152" fill="none" stroke-linejoin="round" stroke="#0b5cad" stroke-width="1.5"/>
            <rect x="58" y="44" width="424" height="116" fill="none" stroke="#9aa3b2" stroke-width="1"/>
            <text x="58" y="38" font-size="13" fill="#1c2230" text-anchor="start" font-weight="600">leg 1</text>
            <line x1="270" y1="44" x2="270" y2="160" stroke="#b08400" stroke-width="1" stroke-dasharray="2 3"/>
            <text x="270" y="38" font-size="11.5" fill="#7a5c00" text-anchor="middle">middle</text>
            <line x1="274.2" y1="44" x2="274.2" y2="160" stroke="#b08400" stroke-width="1" stroke-dasharray="2 3"/>
            <text x="58" y="176" font-size="11.5" fill="#454c5a" text-anchor="middle">0.0</text>
            <text x="142.8" y="176" font-size="11.5" fill="#454c5a" text-anchor="middle">0.2</text>
            <text x="227.6" y="176" font-size="11.5" fill="#454c5a" text-anchor="middle">0.4</text>
            <text x="312.4" y="176" font-size="11.5" fill="#454c5a" text-anchor="middle">0.6</text>
            <text x="397.2" y="176" font-size="11.5" fill="#454c5a" text-anchor="middle">0.8</text>
            <text x="482" y="176" font-size="11.5" fill="#454c5a" text-anchor="middle">1.0</text>
            <text x="270" y="195" font-size="13" fill="#1c2230" text-anchor="middle">time, s</text>
            <text x="556" y="16" font-size="13" fill="#1c2230" text-anchor="start">right, N</text>
            <line x1="556" y1="148.4" x2="980" y2="148.4" stroke="#e7e9ee" stroke-width="1"/>
            <text x="550" y="152.4" font-size="11.5" fill="#454c5a" text-anchor="end">0.6</text>
            <line x1="556" y1="125.2" x2="980" y2="125.2" stroke="#e7e9ee" stroke-width="1"/>
            <text x="550" y="129.2" font-size="11.5" fill="#454c5a" text-anchor="end">0.8</text>
            <line x1="556" y1="102" x2="980" y2="102" stroke="#e7e9ee" stroke-width="1"/>
            <text x="550" y="106" font-size="11.5" fill="#454c5a" text-anchor="end">1.0</text>
            <line x1="556" y1="78.8" x2="980" y2="78.8" stroke="#e7e9ee" stroke-width="1"/>
            <text x="550" y="82.8" font-size="11.5" fill="#454c5a" text-anchor="end">1.2</text>
            <line x1="556" y1="55.6" x2="980" y2="55.6" stroke="#e7e9ee" stroke-width="1"/>
            <text x="550" y="59.6" font-size="11.5" fill="#454c5a" text-anchor="end">1.4</text>
            <line x1="556" y1="44" x2="556" y2="160" stroke="#e7e9ee" stroke-width="1"/>
            <line x1="640.8" y1="44" x2="640.8" y2="160" stroke="#e7e9ee" stroke-width="1"/>
            <line x1="725.6" y1="44" x2="725.6" y2="160" stroke="#e7e9ee" stroke-width="1"/>
            <line x1="810.4" y1="44" x2="810.4" y2="160" stroke="#e7e9ee" stroke-width="1"/>
            <line x1="895.2" y1="44" x2="895.2" y2="160" stroke="#e7e9ee" stroke-width="1"/>
            <line x1="980" y1="44" x2="980" y2="160" stroke="#e7e9ee" stroke-width="1"/>
            <path d="M556 102M980 102" fill="none" stroke-linejoin="round" stroke="#0b5cad" stroke-width="1.5"/>
            <rect x="556" y="44" width="424" height="116" fill="none" stroke="#9aa3b2" stroke-width="1"/>
            <text x="556" y="38" font-size="13" fill="#1c2230" text-anchor="start" font-weight="600">leg 1</text>
            <line x1="768" y1="44" x2="768" y2="160" stroke="#b08400" stroke-width="1" stroke-dasharray="2 3"/>
            <text x="768" y="38" font-size="11.5" fill="#7a5c00" text-anchor="middle">middle</text>
            <line x1="772.2" y1="44" x2="772.2" y2="160" stroke="#b08400" stroke-width="1" stroke-dasharray="2 3"/>
            <text x="556" y="176" font-size="11.5" fill="#454c5a" text-anchor="middle">0.0</text>
            <text x="640.8" y="176" font-size="11.5" fill="#454c5a" text-anchor="middle">0.2</text>
            <text x="725.6" y="176" font-size="11.5" fill="#454c5a" text-anchor="middle">0.4</text>
            <text x="810.4" y="176" font-size="11.5" fill="#454c5a" text-anchor="middle">0.6</text>
            <text x="895.2" y="176" font-size="11.5" fill="#454c5a" text-anchor="middle">0.8</text>
            <text x="980" y="176" font-size="11.5" fill="#454c5a" text-anchor="middle">1.0</text>
            <text x="768" y="195" font-size="13" fill="#1c2230" text-anchor="middle">time, s</text>
            </svg>
        "##]].assert_eq(&figure.draw().file());
    }
}
