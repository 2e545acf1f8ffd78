//! The platform at home, from its numbers: an oblique view and one from above, legs numbered.

use dyn_platform::Platform;

use super::axis::fixed;
use super::svg::{Font, NO_STROKE, Stroke, Svg};

type Point = [f64; 3];

const STATOR: Stroke = Stroke::solid("#39424f", 17.0);
const MOVER: Stroke = Stroke::solid("#8a95a5", 8.0);
const ROD: Stroke = Stroke::solid("#0b5cad", 4.5);
const PLATE_EDGE: Stroke = Stroke::solid("#5d6878", 1.2);
const DIMENSION: Stroke = Stroke { color: "#7a8494", width: 1.0, dash: "4 3" };
const JOINT_EDGE: Stroke = Stroke::solid("#ffffff", 1.2);
const HOOKE: &str = "#c8452b";
const UNIVERSAL: &str = "#0b5cad";
const NUMBER: Font = Font::new(16.0, "#1c2230", "middle").bold();
const LABEL: Font = Font::new(13.0, "#454c5a", "start");

/// Joints of every leg with the platform at home, m, base axes.
struct Assembly {
    base_point: [Point; 6],
    /// End of the fixed part of the actuator: for the eye only, at half the actuator's length.
    stator_end: [Point; 6],
    hooke_joint: [Point; 6],
    platform_joint: [Point; 6],
    payload_com: Point,
}

impl Assembly {
    fn new(platform: &Platform) -> Self {
        let parameters = &platform.parameters;
        let home = |point: Point| add(platform.home.position, 1.0, rotate(platform.home.rotation, point));
        let platform_joint = parameters.platform_point.map(home);
        let uhp = parameters.leg_vectors("actuator_axis").zip(parameters.legs("rod_length"));
        let along = |leg: usize, share: f64| {
            let start = parameters.base_point[leg];
            // Legs without an axis of their own stretch between their joints: the Hooke joint is on the base.
            let Some((axes, rod_lengths)) = uhp else { return start };
            let to_joint = add(platform_joint[leg], -1.0, start);
            let length = actuator_length(to_joint, axes[leg], rod_lengths[leg]);
            add(start, share * length, axes[leg])
        };
        Self {
            base_point: parameters.base_point,
            stator_end: std::array::from_fn(|leg| along(leg, 0.5)),
            hooke_joint: std::array::from_fn(|leg| along(leg, 1.0)),
            platform_joint,
            payload_com: home(parameters.payload_com),
        }
    }

    fn points(&self) -> impl Iterator<Item = Point> {
        let legs = [self.base_point, self.hooke_joint, self.platform_joint];
        legs.into_iter().flatten().chain([self.payload_com])
    }
}

/// (18): `a.l - sqrt((a.l)^2 - l.l + s^2)`, m; a rod that does not reach is drawn to its nearest point.
fn actuator_length(to_joint: Point, axis: Point, rod_length: f64) -> f64 {
    let along = dot(axis, to_joint);
    along - (along * along - dot(to_joint, to_joint) + rod_length * rod_length).max(0.0).sqrt()
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `a + factor b`.
fn add(a: Point, factor: f64, b: Point) -> Point {
    std::array::from_fn(|i| a[i] + factor * b[i])
}

fn rotate(rotation: [Point; 3], vector: Point) -> Point {
    rotation.map(|row| dot(row, vector))
}

/// A circle, as a polygon, that holds all points: about their mean, `margin` times as wide, in the plane of the first
/// two columns of `rotation`.
fn plate(points: &[Point; 6], rotation: [Point; 3], margin: f64) -> (Point, f64, Vec<Point>) {
    let centre = points.iter().fold([0.0; 3], |sum, point| add(sum, 1.0 / 6.0, *point));
    let distance = |point: &Point| {
        let arm = add(*point, -1.0, centre);
        dot(arm, arm).sqrt()
    };
    let radius = points.iter().map(distance).fold(0.0, f64::max);
    let rim = (0..72).map(|step| {
        let (sine, cosine) = (f64::from(step) * std::f64::consts::TAU / 72.0).sin_cos();
        add(centre, margin * radius, rotate(rotation, [cosine, sine, 0.0]))
    });
    (centre, radius, rim.collect())
}

/// Parallel projection: two rows give right and up in the picture, the third points to the viewer.
struct View {
    axes: [Point; 3],
    /// Pixels per metre.
    scale: f64,
    /// Pixel of the origin.
    origin: [f64; 2],
}

impl View {
    /// A view along `axes` that fits `points` into the box.
    fn fit(axes: [Point; 3], points: &[Point], corner: [f64; 2], size: [f64; 2]) -> Self {
        let seen = points.iter().map(|point| rotate(axes, *point));
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in seen {
            for i in 0..2 {
                low[i] = low[i].min(point[i]);
                high[i] = high[i].max(point[i]);
            }
        }
        let scale = (size[0] / (high[0] - low[0])).min(size[1] / (high[1] - low[1]));
        let centre = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])];
        let origin =
            [corner[0] + 0.5 * size[0] - scale * centre[0], corner[1] + 0.5 * size[1] + scale * centre[1]];
        Self { axes, scale, origin }
    }

    fn pixel(&self, point: Point) -> [f64; 2] {
        let [right, up, _] = rotate(self.axes, point);
        [self.origin[0] + self.scale * right, self.origin[1] - self.scale * up]
    }

    /// A point moved outwards in the picture, away from `centre`, by `pixels`.
    fn outwards(&self, point: Point, centre: Point, pixels: f64) -> [f64; 2] {
        let ([x, y], [cx, cy]) = (self.pixel(point), self.pixel(centre));
        let length = (x - cx).hypot(y - cy).max(1e-9);
        [x + pixels * (x - cx) / length, y + pixels * (y - cy) / length]
    }
}

/// Oblique view to the left, view from above to the right.
pub(super) fn platform_drawing(platform: &Platform) -> Svg {
    let assembly = Assembly::new(platform);
    let mut svg = Svg::new(1000.0, 520.0, &format!("The platform {} at home", platform.name));
    svg.rect([0.0, 0.0], [1000.0, 520.0], "#ffffff", NO_STROKE);
    oblique(&mut svg, platform, &assembly);
    from_above(&mut svg, platform, &assembly);
    svg
}

const UPRIGHT: [Point; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

fn oblique(svg: &mut Svg, platform: &Platform, assembly: &Assembly) {
    let (azimuth, elevation) = (-52f64.to_radians(), 22f64.to_radians());
    let (sa, ca, se, ce) = (azimuth.sin(), azimuth.cos(), elevation.sin(), elevation.cos());
    let axes = [[-sa, ca, 0.0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]];
    let (base_centre, base_radius, base_rim) = plate(&assembly.base_point, UPRIGHT, 1.14);
    let (_, _, top_rim) = plate(&assembly.platform_joint, platform.home.rotation, 1.14);
    let everything: Vec<Point> =
        assembly.points().chain(base_rim.iter().copied()).chain(top_rim.iter().copied()).collect();
    let view = View::fit(axes, &everything, [30.0, 20.0], [440.0, 430.0]);
    let rim = |points: &[Point]| -> Vec<[f64; 2]> { points.iter().map(|point| view.pixel(*point)).collect() };

    svg.polygon(&rim(&base_rim), "#eef1f5", 1.0, PLATE_EDGE);
    triad(svg, &view, base_centre, 0.55 * base_radius);

    let mut back_to_front: Vec<usize> = (0..6).collect();
    let nearness = |leg: &usize| dot(axes[2], assembly.hooke_joint[*leg]);
    back_to_front.sort_by(|a, b| nearness(a).total_cmp(&nearness(b)));
    for leg in back_to_front {
        let [base, stator, hooke, top] =
            [&assembly.base_point, &assembly.stator_end, &assembly.hooke_joint, &assembly.platform_joint]
                .map(|points| view.pixel(points[leg]));
        svg.line(base, hooke, MOVER);
        svg.line(base, stator, STATOR);
        let middle = [0.5 * (base[0] + stator[0]), 0.5 * (base[1] + stator[1]) + 5.0];
        svg.text(middle, &(leg + 1).to_string(), Font { size: 14.0, color: "#ffffff", ..NUMBER });
        svg.line(hooke, top, ROD);
        svg.circle(hooke, 7.0, HOOKE, JOINT_EDGE);
        svg.circle(top, 6.0, UNIVERSAL, JOINT_EDGE);
    }
    svg.polygon(&rim(&top_rim), "#9db8d6", 0.45, PLATE_EDGE);
    let com = view.pixel(assembly.payload_com);
    svg.circle(com, 6.5, "#ffffff", Stroke::solid("#1c2230", 1.5));
    svg.circle(com, 2.0, "#1c2230", NO_STROKE);
    key(svg, [30.0, 500.0]);
}

/// The base's axes.
fn triad(svg: &mut Svg, view: &View, origin: Point, length: f64) {
    let axes = [("x", "#b3261e"), ("y", "#2e7d32"), ("z", "#0b5cad")];
    for ((name, color), direction) in axes.into_iter().zip(UPRIGHT) {
        let tip = add(origin, length, direction);
        svg.line(view.pixel(origin), view.pixel(tip), Stroke::solid(color, 1.8));
        let [x, y] = view.outwards(tip, origin, 9.0);
        svg.text([x, y + 4.0], name, Font::new(13.0, color, "middle"));
    }
}

/// What the colours mean.
fn key(svg: &mut Svg, [x, y]: [f64; 2]) {
    let line = |svg: &mut Svg, x: f64, stroke: Stroke, text: &str| {
        svg.line([x, y - 5.0], [x + 22.0, y - 5.0], stroke);
        svg.text([x + 28.0, y], text, LABEL);
    };
    line(svg, x, STATOR, "actuator");
    line(svg, x + 98.0, MOVER, "mover");
    let dot = |svg: &mut Svg, x: f64, color: &str, edge: Stroke, text: &str| {
        svg.circle([x, y - 5.0], 6.0, color, edge);
        svg.text([x + 12.0, y], text, LABEL);
    };
    dot(svg, x + 190.0, HOOKE, JOINT_EDGE, "Hooke joint");
    line(svg, x + 290.0, ROD, "rod");
    dot(svg, x + 364.0, UNIVERSAL, JOINT_EDGE, "universal joint");
    dot(svg, x + 488.0, "#ffffff", Stroke::solid("#1c2230", 1.5), "payload\u{2019}s centre of mass");
}

fn from_above(svg: &mut Svg, platform: &Platform, assembly: &Assembly) {
    let (base_centre, base_radius, base_rim) = plate(&assembly.base_point, UPRIGHT, 1.14);
    let (top_centre, top_radius, top_rim) = plate(&assembly.platform_joint, platform.home.rotation, 1.14);
    let view = View::fit(UPRIGHT, &base_rim, [560.0, 34.0], [400.0, 400.0]);
    let rim = |points: &[Point]| -> Vec<[f64; 2]> { points.iter().map(|point| view.pixel(*point)).collect() };
    svg.polygon(&rim(&base_rim), "#eef1f5", 1.0, PLATE_EDGE);
    svg.polygon(&rim(&plate(&assembly.base_point, UPRIGHT, 1.0).2), "none", 0.0, DIMENSION);
    svg.polygon(&rim(&top_rim), "#9db8d6", 0.45, PLATE_EDGE);
    svg.polygon(
        &rim(&plate(&assembly.platform_joint, platform.home.rotation, 1.0).2),
        "none",
        0.0,
        DIMENSION,
    );
    for leg in 0..6 {
        let [hooke, top] =
            [&assembly.hooke_joint, &assembly.platform_joint].map(|points| view.pixel(points[leg]));
        svg.circle(view.pixel(assembly.base_point[leg]), 0.5 * STATOR.width + 2.5, STATOR.color, NO_STROKE);
        svg.line(hooke, top, ROD);
        svg.circle(hooke, 7.0, HOOKE, JOINT_EDGE);
        svg.circle(top, 6.0, UNIVERSAL, JOINT_EDGE);
        let [x, y] = view.outwards(assembly.base_point[leg], base_centre, 36.0);
        svg.text([x, y + 6.0], &(leg + 1).to_string(), NUMBER);
    }
    radius_line(svg, &view, base_centre, base_radius, 180.0);
    radius_line(svg, &view, top_centre, top_radius, 0.0);
    let names = [("x", "#b3261e", UPRIGHT[0]), ("y", "#2e7d32", UPRIGHT[1])];
    let corner = add(base_centre, 1.0, [-1.12 * base_radius, -1.12 * base_radius, 0.0]);
    for (name, color, direction) in names {
        let tip = add(corner, 0.25 * base_radius, direction);
        svg.line(view.pixel(corner), view.pixel(tip), Stroke::solid(color, 1.8));
        let [x, y] = view.outwards(tip, corner, 9.0);
        svg.text([x, y + 4.0], name, Font::new(13.0, color, "middle"));
    }
}

/// The radius of the circle on which joints lie, from its centre at `angle` degrees.
fn radius_line(svg: &mut Svg, view: &View, centre: Point, radius: f64, angle: f64) {
    let (sine, cosine) = angle.to_radians().sin_cos();
    let [from, to] = [centre, add(centre, radius, [cosine, sine, 0.0])].map(|point| view.pixel(point));
    svg.line(from, to, Stroke::solid("#7a8494", 1.0));
    svg.circle(from, 2.0, "#7a8494", NO_STROKE);
    let middle = [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1]) - 6.0];
    svg.text(middle, &format!("{} mm", fixed(1e3 * radius, 0)), Font { anchor: "middle", ..LABEL });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rods_reach_from_joint_to_joint() {
        let platform = super::super::example::platform();
        let assembly = Assembly::new(&platform);
        for leg in 0..6 {
            let rod = add(assembly.platform_joint[leg], -1.0, assembly.hooke_joint[leg]);
            assert!((dot(rod, rod).sqrt() - 0.206).abs() < 1e-12);
            let actuator = add(assembly.hooke_joint[leg], -1.0, assembly.base_point[leg]);
            assert!((dot(actuator, actuator).sqrt() - 0.19821).abs() < 1e-5);
        }
    }

    #[test]
    fn every_leg_has_its_number_in_both_views() {
        let drawing = platform_drawing(&super::super::example::platform()).inline();
        for leg in 1..=6 {
            assert_eq!(drawing.matches(&format!(">{leg}</text>")).count(), 2, "leg {leg}");
        }
    }
}
