//! The smallest distance of a camera that orbits an axis.
//!
//! While the camera orbits, a point at height h and distance ρ from the axis describes a circle in camera
//! space. The camera looks at height s on the axis from a distance d, at an elevation e. With α as the
//! orbit angle, the point is
//!
//! * x = ρ cos α to the right,
//! * y = (h − s) cos e − ρ sin α sin e upwards,
//! * z = d − (h − s) sin e − ρ sin α cos e away
//!
//! from it. It is below the upper edge of an image whose half height has the tangent t if y ≤ t z for all
//! α. The largest value of a cos α + b sin α is √(a² + b²), so this holds if
//!
//! * t d + s (cos e + t sin e) ≥ h (cos e + t sin e) + ρ |t cos e − sin e|; it is above the lower edge if
//! * t d − s (cos e − t sin e) ≥ −h (cos e − t sin e) + ρ |t cos e + sin e|; and between the left and
//!   right edges, whose tangent is w, if
//! * w d + s w sin e ≥ h w sin e + ρ √(1 + (w cos e)²).
//!
//! These inequalities are linear in d and s, so only the largest right-hand side over all points matters.
//! A sphere of radius r adds r √(1 + t²), or r √(1 + w²). s is chosen so that the margins above and below
//! are equal: both of the first conditions hold with equality for the same t. That is the image's t
//! unless the width requires a larger d; then it is the t for which the third holds with equality too.

use super::Turntable;
use crate::posed::Posed;
use crate::{CanonicalShape, Geometry, Scene, corners};
use glam::DAffine3;

/// The geometry to be framed, around an axis along y.
pub(super) struct Swept {
    /// Distance from the axis and height of points: the relevant part of the convex hull.
    points: Vec<[f64; 2]>,
    /// Distance from the axis and height of spheres' centres, and their radii.
    spheres: Vec<[f64; 3]>,
}

/// The camera's position.
pub(super) struct View {
    /// Distance of the camera from its target.
    pub distance: f64,
    /// Height of the target on the axis.
    pub height: f64,
}

impl Swept {
    /// All bounded geometry in `scene`, visible or not, at many times of its animation: vertices, spheres, and
    /// the corners of other shapes' boxes.
    pub fn new(scene: &Scene, pivot_from_world: DAffine3) -> Self {
        let mut swept = Self {
            points: Vec::new(),
            spheres: Vec::new(),
        };
        let (moving, nodes) = (scene.moving_instances(), scene.moving_nodes());
        for (index, time) in scene.moments().into_iter().enumerate() {
            let posed = Posed::new(scene, time);
            let counts = |moves: bool| moves || index == 0;
            let instances = scene.instances.iter().zip(&moving);
            for (instance, _) in instances.filter(|(_, moves)| counts(**moves)) {
                let pivot_from_object = pivot_from_world * posed.world_from_object(instance);
                (swept.points).extend(posed.points(instance.mesh).map(|p| {
                    let p = pivot_from_object.transform_point3(p);
                    [p.x.hypot(p.z), p.y]
                }));
                swept.points = hull(swept.points);
            }
            for shape in &scene.shapes {
                if counts(shape.node.is_some_and(|node| nodes[node])) {
                    let pivot_from_node = pivot_from_world * posed.world_from(shape.node);
                    swept.add(shape.geometry.placed(pivot_from_node));
                }
            }
            swept.points = hull(swept.points);
        }
        swept
    }

    fn add(&mut self, geometry: Geometry) {
        let Geometry::Placed {
            canonical,
            world_from_canonical: place,
        } = geometry
        else {
            return;
        };
        if let (CanonicalShape::Ellipsoid, Some(radius)) = (canonical, even_scale(place)) {
            let center = place.translation;
            self.spheres
                .push([center.x.hypot(center.z), center.y, radius]);
            return;
        }
        let at_home = Geometry::Placed {
            canonical,
            world_from_canonical: DAffine3::IDENTITY,
        };
        if let Some(bounds) = at_home.bounds() {
            self.points.extend(corners(bounds).map(|corner| {
                let p = place.transform_point3(corner);
                [p.x.hypot(p.z), p.y]
            }));
        }
    }

    /// The largest of `by_height` · h + `by_distance` · ρ + `by_radius` · r.
    fn most(&self, by_height: f64, by_distance: f64, by_radius: f64) -> f64 {
        let points = (self.points.iter()).map(|[rho, h]| by_height * h + by_distance * rho);
        let spheres = (self.spheres.iter())
            .map(|[rho, h, r]| by_height * h + by_distance * rho + by_radius * r);
        points.chain(spheres).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The largest distance of the geometry from the point of the axis at `height`.
    pub fn radius(&self, height: f64) -> f64 {
        let points = (self.points.iter()).map(|[rho, h]| rho.hypot(h - height));
        let spheres = (self.spheres.iter()).map(|[rho, h, r]| rho.hypot(h - height) + r);
        points.chain(spheres).fold(0.0, f64::max)
    }

    /// The nearest view with equal margins above and below.
    pub fn view(&self, elevation: f64, options: &Turntable) -> View {
        let (sin, cos) = elevation.sin_cos();
        let tangent = (options.fov_y / 2.0).tan() * (1.0 - options.margin);
        let side = tangent * options.aspect;

        let centred = |t: f64| {
            let by_radius = (1.0 + t * t).sqrt();
            let above = self.most(cos + t * sin, (t * cos - sin).abs(), by_radius);
            let below = self.most(t * sin - cos, (t * cos + sin).abs(), by_radius);
            let height = (above - below) / (2.0 * cos);
            View {
                distance: (above - height * (cos + t * sin)) / t,
                height,
            }
        };
        let across = self.most(side * sin, 1.0_f64.hypot(side * cos), 1.0_f64.hypot(side));
        let distance_by_sides = |height: f64| across / side - height * sin;
        let is_between_sides = |view: &View| view.distance >= distance_by_sides(view.height);

        let view = centred(tangent);
        if is_between_sides(&view) {
            return view;
        }
        let (mut low, mut high) = (1e-6 * tangent, tangent);
        for _ in 0..100 {
            let middle = low.midpoint(high);
            *(if is_between_sides(&centred(middle)) {
                &mut low
            } else {
                &mut high
            }) = middle;
        }
        let height = centred(high).height;
        View {
            distance: distance_by_sides(height),
            height,
        }
    }
}

/// The factor of a map that scales uniformly; `None` for others.
fn even_scale(map: DAffine3) -> Option<f64> {
    let [x, y, z] = [map.matrix3.x_axis, map.matrix3.y_axis, map.matrix3.z_axis];
    let square = x.length_squared();
    let off = [
        y.length_squared() - square,
        z.length_squared() - square,
        x.dot(y),
        y.dot(z),
        z.dot(x),
    ];
    let is_even = off.iter().all(|off| off.abs() <= 1e-12 * square);
    is_even.then(|| square.sqrt())
}

/// The points of the convex hull between the lowest and the highest, on the side away from the axis
/// (Andrew's monotone chain, 1979): the only points that can be extreme in a direction away from the
/// axis.
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_unstable_by(|a, b| a[1].total_cmp(&b[1]).then(a[0].total_cmp(&b[0])));
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for point in points {
        while let [.., a, b] = kept[..] {
            // Whether b lies outside of the line from a to the point.
            let is_outside = (b[0] - a[0]) * (point[1] - a[1]) > (point[0] - a[0]) * (b[1] - a[1]);
            if is_outside {
                break;
            }
            kept.pop();
        }
        kept.push(point);
    }
    kept
}
