//! Triangulated polygons: the triangles cover the polygon, lie inside it, and keep its orientation.

use super::{file, scene, triangles};
use crate::support::effort;
use crate::support::random::Random;
use glam::{DMat3, DVec2, DVec3};
use glimray::import;
use std::f64::consts::TAU;
use std::fmt::Write;

/// The signed area, by the shoelace formula.
fn area(outline: &[DVec2]) -> f64 {
    let next = |i: usize| outline[(i + 1) % outline.len()];
    (0..outline.len())
        .map(|i| outline[i].perp_dot(next(i)) / 2.0)
        .sum()
}

/// Whether a ray to the right leaves the outline an odd number of times.
fn is_inside(outline: &[DVec2], p: DVec2) -> bool {
    let crosses = |i: usize| {
        let (a, b) = (outline[i], outline[(i + 1) % outline.len()]);
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    };
    (0..outline.len()).filter(|&i| crosses(i)).count() % 2 == 1
}

/// A file with the outline as a polygon in the xy plane of `turn`, through `center`.
fn polygon(outline: &[DVec2], turn: DMat3, center: DVec3) -> String {
    let mut text = format!("p {}", outline.len());
    for p in outline {
        let p = center + turn * p.extend(0.0);
        write!(text, "\n{:?} {:?} {:?}", p.x, p.y, p.z).expect("text");
    }
    file(&text)
}

/// Describes what is wrong with the triangles of the outline, if anything.
fn fault(outline: &[DVec2], turn: DMat3, center: DVec3) -> Option<String> {
    let scene = scene("a.nff", polygon(outline, turn, center));
    let flat = |p: DVec3| (turn.transpose() * (p - center)).truncate();
    let sign = area(outline).signum();
    let mut sum = 0.0;
    for triangle in triangles(&scene) {
        let triangle = triangle.map(flat);
        let part = area(&triangle) * sign;
        // Triangles too thin for f32 may be flipped by rounding.
        if part < -1e-6 * area(outline).abs() {
            return Some(format!("{triangle:?} is turned over"));
        }
        sum += part;
        let middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
        if part > 1e-6 * area(outline).abs() && !is_inside(outline, middle) {
            return Some(format!("{triangle:?} is outside"));
        }
    }
    let expected = area(outline).abs();
    if (sum - expected).abs() > 1e-5 * expected {
        return Some(format!("an area of {sum} instead of {expected}"));
    }
    let normal = turn.z_axis * sign;
    let is_along = |n: &glam::Vec3| n.as_dvec3().distance(normal) < 1e-5;
    (!scene.meshes[0].normals.iter().all(is_along)).then(|| "a normal is wrong".to_owned())
}

/// Points around the origin at these distances.
fn star(radii: impl ExactSizeIterator<Item = f64>) -> Vec<DVec2> {
    let count = radii.len() as f64;
    let corner = |(i, r)| DVec2::from_angle(TAU * i as f64 / count) * r;
    radii.enumerate().map(corner).collect()
}

fn spiral(count: usize, turns: f64) -> Vec<DVec2> {
    let half = count / 2;
    let arm = |offset: f64, i: usize| {
        let along = i as f64 / half as f64;
        DVec2::from_angle(TAU * turns * along) * (1.0 + offset + turns * along)
    };
    let outwards = (0..half).map(|i| arm(0.5, i));
    outwards
        .chain((0..half).rev().map(|i| arm(0.0, i)))
        .collect()
}

fn comb(count: usize) -> Vec<DVec2> {
    let corner = |i: usize| DVec2::new(i as f64, if (i / 2).is_multiple_of(2) { 0.0 } else { 9.0 });
    let (first, last) = (DVec2::new(0.0, -1.0), DVec2::new(count as f64, -1.0));
    std::iter::once(first)
        .chain((1..count).map(corner))
        .chain([last])
        .rev()
        .collect()
}

#[test]
fn concave_polygons_are_triangulated_exactly() {
    let points = |list: &[(f64, f64)]| list.iter().map(|&p| DVec2::from(p)).collect::<Vec<_>>();
    let outlines = [
        ("triangle", points(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])),
        (
            "arrowhead",
            points(&[(0.0, 0.0), (2.0, 0.0), (0.5, 0.5), (0.0, 2.0)]),
        ),
        (
            "L",
            points(&[
                (0.0, 0.0),
                (2.0, 0.0),
                (2.0, 1.0),
                (1.0, 1.0),
                (1.0, 3.0),
                (0.0, 3.0),
            ]),
        ),
        (
            "square with corners on its edges",
            points(&[
                (0.0, 0.0),
                (1.0, 0.0),
                (2.0, 0.0),
                (2.0, 1.0),
                (2.0, 2.0),
                (0.0, 2.0),
                (0.0, 1.0),
            ]),
        ),
        (
            "square with a hole by a seam",
            points(&[
                (0.0, 0.0),
                (4.0, 0.0),
                (4.0, 4.0),
                (0.0, 4.0),
                (0.0, 0.0),
                (1.0, 1.0),
                (1.0, 2.0),
                (2.0, 2.0),
                (2.0, 1.0),
                (1.0, 1.0),
            ]),
        ),
        ("regular", star([1.0; 100].into_iter())),
        (
            "sharp star",
            star((0..2000).map(|i| if i % 2 == 0 { 1.0 } else { 0.2 })),
        ),
        ("comb", comb(601)),
        ("spiral", spiral(3000, 12.0)),
    ];
    let mut faults = Vec::new();
    for (name, outline) in outlines {
        let backwards: Vec<_> = outline.iter().rev().copied().collect();
        let oblique = DMat3::from_rotation_y(0.7) * DMat3::from_rotation_x(-1.9);
        for (turn, center) in [
            (DMat3::IDENTITY, DVec3::ZERO),
            (oblique, DVec3::new(3.0, -2.0, 5.0)),
            (DMat3::from_rotation_y(TAU / 4.0), DVec3::ZERO),
            (DMat3::from_rotation_x(TAU / 4.0), DVec3::ZERO),
        ] {
            for outline in [&outline, &backwards] {
                let fault = fault(outline, turn, center);
                faults.extend(fault.map(|fault| format!("{name}: {fault}")));
            }
        }
    }
    assert_eq!(faults, [""; 0]);
}

/// Polygons that are star-shaped about their centre do not intersect themselves.
#[test]
fn any_star_shaped_polygon_is_covered() {
    let mut random = Random::new(30);
    let mut faults = Vec::new();
    for _ in 0..200 {
        let count = 3 + random.below(120);
        let radii: Vec<f64> = (0..count).map(|_| random.between(0.1, 1.0)).collect();
        let outline = star(radii.into_iter());
        let (axis, angle) = (random.direction(), random.between(0.0, TAU));
        let turn = DMat3::from_axis_angle(axis, angle);
        faults.extend(fault(&outline, turn, 3.0 * random.in_cube()));
    }
    assert_eq!(faults, [""; 0]);
}

#[test]
fn corners_of_patches_keep_their_normals() {
    let text = "pp 4 0 0 0 1 0 1  2 0 0 0 0 5  0.5 0.5 0 0 3 4  0 2 0 -1 0 1";
    let scene = scene("a.nff", file(text));
    let mesh = &scene.meshes[0];
    let half = 0.5_f32.sqrt();
    let expected = [
        [half, 0.0, half],
        [0.0, 0.0, 1.0],
        [0.0, 0.6, 0.8],
        [-half, 0.0, half],
    ];
    assert_eq!(mesh.normals.len(), expected.len());
    for (normal, expected) in mesh.normals.iter().zip(expected) {
        assert!(normal.distance(expected.into()) < 1e-6, "{normal}");
    }
    assert_eq!(mesh.triangles.len(), 2);
    // The notch is at the third corner: both triangles share it.
    assert!(mesh.triangles.iter().all(|triangle| triangle.contains(&2)));
}

/// Self-intersecting outlines, on which ear clippers take cubic time.
#[test]
fn self_intersecting_polygons_become_fans_quickly() {
    const COUNT: usize = 16_000;
    let mut random = Random::new(7);
    let round = |step: usize| {
        let corner = |i: usize| DVec2::from_angle(TAU * (i * step) as f64 / COUNT as f64);
        (0..COUNT).map(corner).collect::<Vec<_>>()
    };
    let petal = |i: usize| match i % 3 {
        0 => DVec2::ZERO,
        1 => DVec2::from_angle(i as f64 / COUNT as f64),
        _ => DVec2::from_angle((i as f64 - 1.5) / COUNT as f64),
    };
    let spots = |i: usize| DVec2::new((i % 2) as f64, (i % 3) as f64);
    let corner = |i: usize| [DVec2::ZERO, DVec2::X, DVec2::Y][i % 3];
    let outer = [
        DVec2::new(3.0, 0.0),
        DVec2::new(0.0, 3.0),
        DVec2::splat(-3.0),
    ];
    let outlines = [
        (
            "random",
            (0..COUNT).map(|_| random.in_cube().truncate()).collect(),
        ),
        ("round 7 times", round(7)),
        ("round half as often as corners", round(COUNT / 2 - 1)),
        ("a few spots", (0..COUNT).map(spots).chain(outer).collect()),
        (
            "triangle over and over",
            (0..COUNT - 1).map(corner).collect(),
        ),
        (
            "petals",
            (0..COUNT).map(petal).chain(outer).collect::<Vec<_>>(),
        ),
    ];
    for (name, outline) in outlines {
        let text = polygon(&outline, DMat3::IDENTITY, DVec3::ZERO);
        let scene = effort::within(5000.0, || scene("a.nff", text));
        let note = "polygons that intersect themselves or are too large, triangulated as fans: 1";
        assert!(scene.skipped.contains(&note.to_owned()), "{name}");
    }
}

#[test]
fn total_triangulation_time_is_bounded() {
    let comb = polygon(&comb(16_001), DMat3::IDENTITY, DVec3::ZERO);
    let (head, one) = comb.split_once("\np ").expect("a polygon");
    let text = format!("{head}{}", format!("\np {one}").repeat(8));
    let parsed = effort::within(30_000.0, || {
        import::parse("a.nff", &text, &Default::default())
    });
    let scene = parsed.expect("a scene");
    let note = "polygons that intersect themselves or are too large, triangulated as fans: ";
    let is_noted =
        |scene: &glimray::scene::Scene| scene.skipped.iter().any(|it| it.starts_with(note));
    assert!(is_noted(&scene), "{:?}", scene.skipped);

    let large = star((0..20_000).map(|i| if i % 2 == 0 { 1.0 } else { 0.5 }));
    let scene = super::scene("a.nff", polygon(&large, DMat3::IDENTITY, DVec3::ZERO));
    assert!(is_noted(&scene), "{:?}", scene.skipped);
}
