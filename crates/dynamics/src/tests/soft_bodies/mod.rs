//! Cloths and volumes among bodies and mechanisms.

mod ropes;

use super::*;
use ropes::pin;
use scene::shape::soft::body::Body;
use scene::shape::soft::{Pin, Soft};
use scene::shape::{Appearance, Material, Shape};

/// A square sheet in the plane of x and y, around a place.
fn cloth(size: f64, cells: u32, at: [f64; 3]) -> Body {
    let count = cells + 1;
    let point = |n: u32| {
        let [x, y] = [n % count, n / count].map(|i| size * (f64::from(i) / f64::from(cells) - 0.5));
        [at[0] + x, at[1] + y, at[2]]
    };
    let cells = (0..cells * cells).map(|n| n / cells * count + n % cells);
    let triangles = cells.flat_map(|a| {
        let [b, c, d] = [a + 1, a + count, a + count + 1];
        [[a, b, d], [a, d, c]]
    });
    Body {
        radius: 0.002,
        density: 0.5,
        stretch: 2000.0,
        bend: 1e-4,
        poisson: 0.3,
        damping: 0.01,
        drag: 1.0,
        strength: f64::INFINITY,
        flat: true,
        points: (0..count * count).map(point).collect(),
        triangles: triangles.collect(),
        ..Body::default()
    }
}

/// A block of rubber of two cells along each axis, around a place.
fn block(size: f64, at: [f64; 3]) -> Body {
    let point = |n: u32| {
        let steps = [n % 3, n / 3 % 3, n / 9].map(|i| size * (0.5 * f64::from(i) - 0.5));
        [0, 1, 2].map(|axis| at[axis] + steps[axis])
    };
    let mut tetrahedra = Vec::new();
    for cell in [0, 1, 3, 4, 9, 10, 12, 13] {
        let corner = |bits: u32| cell + (bits & 1) + 3 * (bits >> 1 & 1) + 9 * (bits >> 2);
        for [a, b] in [[1, 3], [3, 2], [2, 6], [6, 4], [4, 5], [5, 1]] {
            tetrahedra.push([0, a, b, 7].map(corner));
        }
    }
    let mut faces = std::collections::BTreeMap::new();
    for [a, b, c, d] in &tetrahedra {
        for face in [[*a, *c, *b], [*a, *b, *d], [*a, *d, *c], [*b, *c, *d]] {
            let mut name = face;
            name.sort_unstable();
            faces.entry(name).or_insert((face, 0)).1 += 1;
        }
    }
    let surface = faces.into_values().filter(|(_, count)| *count == 1);
    Body {
        density: 1000.0,
        young: 1e5,
        points: (0..27).map(point).collect(),
        triangles: surface.map(|(face, _)| face).collect(),
        tetrahedra,
        ..cloth(1.0, 1, [0.0; 3])
    }
}

impl Bench {
    fn soft_body(&mut self, body: &Body, pins: &[Pin]) -> Handle {
        assert_eq!(body.fault(), None);
        let soft = Soft::Body(body.clone());
        let mut shape = Shape::of_soft(&soft, Appearance::new([0.5; 3])).expect("a mesh");
        shape.material = Material::of_friction(1.0);
        let kind = Kind::Shape(Box::new(shape));
        let handle = self.scene.add("soft", kind).expect("room");
        self.scene.set_soft(handle, &soft).expect("exists");
        self.scene.set_pins(handle, pins).expect("exists");
        handle
    }

    fn points(&self, soft: Handle) -> Vec<[f64; 3]> {
        self.scene.soft_form(soft).expect("it is soft").points
    }
}

#[test]
fn a_sheet_held_at_its_corners_bears_a_box() {
    let mut bench = Bench::new();
    let corners = [0, 8, 72, 80];
    let sheet = cloth(0.4, 8, [0.0, 0.0, 1.0]);
    let pins: Vec<Pin> = corners
        .iter()
        .map(|corner| pin(*corner, None, sheet.points[*corner]))
        .collect();
    let handle = bench.soft_body(&sheet, &pins);
    let body = bench.shape([0.1, 0.1, 0.05], [0.0, 0.0, 1.03], 0.4, true, true);
    bench.run(150);
    let form = bench.scene.soft_form(handle).expect("it is soft");
    let borne: f64 = form.pin_forces.iter().map(|force| force[2]).sum();
    near(borne, (0.4 + 0.5 * 0.16) * 9.81, 0.02);
    let lowest = form
        .points
        .iter()
        .map(|point| point[2])
        .fold(f64::MAX, f64::min);
    near(bench.height(body), lowest + 0.027, 0.01);
    assert!(lowest < 0.99, "{lowest}");
}

#[test]
fn a_sheet_lies_over_a_box_and_its_edges() {
    let mut bench = Bench::new();
    bench.shape([0.2, 0.2, 0.2], [0.0, 0.0, 0.1], 1.0, false, true);
    // Cells half as large as the box: only triangles meet its edges.
    let sheet = cloth(0.5, 5, [0.01, 0.02, 0.25]);
    let handle = bench.soft_body(&sheet, &[]);
    bench.run(100);
    let points = bench.points(handle);
    for triangle in &sheet.triangles {
        for weights in [
            [0.5, 0.5, 0.0],
            [0.5, 0.0, 0.5],
            [0.0, 0.5, 0.5],
            [0.3, 0.3, 0.4],
        ] {
            let at = |axis: usize| {
                let corners = triangle.iter().zip(weights);
                let parts = corners.map(|(node, weight)| points[*node as usize][axis] * weight);
                parts.sum::<f64>()
            };
            let depth = (0.1 - at(0).abs()).min(0.1 - at(1).abs()).min(0.2 - at(2));
            assert!(depth < 1e-3, "{depth}");
        }
    }
    let heights = || points.iter().map(|point| point[2]);
    assert!(heights().fold(0.0, f64::max) > 0.2);
    assert!(heights().fold(1.0, f64::min) < 0.16);
}

#[test]
fn an_arm_bears_a_sheet_by_its_motor() {
    let mut bench = Bench::new();
    let (joint, link) = bench.arm(0.02, 0.25, |joint| {
        joint.set_control(Control::Velocity);
        (joint.target_velocity, joint.target_force) = (0.0, 100.0);
    });
    let mut sheet = cloth(0.2, 4, [0.0; 3]);
    for point in &mut sheet.points {
        *point = [0.5, point[0], 0.9 + point[1]];
    }
    let pins: Vec<Pin> = (20..25)
        .map(|node| pin(node, Some(link), [0.25, sheet.points[node][1], 0.0]))
        .collect();
    bench.soft_body(&sheet, &pins);
    bench.run(100);
    let torque = bench.joint(joint).force.expect("it was measured");
    near(torque.abs(), 9.81 * (0.25 + 0.02 * 0.5), 0.01);
}

#[test]
fn a_soft_block_rests_on_the_floor_and_bears_a_box() {
    let mut bench = Bench::new();
    bench.shape([10.0, 10.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true);
    let soft = bench.soft_body(&block(0.1, [0.0, 0.0, 0.055]), &[]);
    let body = bench.shape([0.1, 0.1, 0.02], [0.0, 0.0, 0.13], 2.0, true, true);
    bench.run(150);
    // Pressed by half of its own weight and by the box: about p / E.
    let expected = 0.104 * (1.0 - (20.0 + 5.0) * 9.81 / 0.1 / 1e5 * 0.1) + 0.01;
    near(bench.height(body), expected, 3e-3);
    let lowest = bench
        .points(soft)
        .iter()
        .map(|p| p[2])
        .fold(f64::MAX, f64::min);
    near(lowest, 0.002, 2e-4);
}

#[test]
fn a_balloon_is_filled_and_torn() {
    let mut bench = Bench::new();
    // Two sheets, one turned over, sewn at the rim.
    let upper = cloth(0.3, 6, [0.0, 0.0, 0.0]);
    let mut cushion = upper.clone();
    let is_rim = |n: u32| [n % 7, n / 7].iter().any(|i| *i == 0 || *i == 6);
    let mut below = Vec::new();
    for n in 0..49 {
        below.push(if is_rim(n) {
            n
        } else {
            cushion.points.push(upper.points[n as usize]);
            cushion.points.len() as u32 - 1
        });
    }
    for (n, point) in (0..).zip(&mut cushion.points) {
        point[2] = if n >= 49 {
            -0.005
        } else if is_rim(n) {
            0.0
        } else {
            0.005
        };
    }
    let lower = upper
        .triangles
        .iter()
        .map(|[a, b, c]| [*a, *c, *b].map(|n| below[n as usize]));
    cushion.triangles.extend(lower);
    (cushion.flat, cushion.pressure) = (false, Some(7.5e5));
    let handle = bench.soft_body(&cushion, &[]);
    bench.gravity(0.0);
    bench.run(60);
    let form = bench.scene.soft_form(handle).expect("it is soft");
    let height = form.points.iter().map(|p| p[2]).fold(0.0, f64::max);
    assert!(height > 0.04, "{height}");
    assert!(
        form.pressure > 100.0 && form.pressure < 5e4,
        "{}",
        form.pressure
    );
    let mut torn = form.clone();
    torn.broken[3] = true;
    let soft = Soft::Body(cushion);
    bench
        .scene
        .report_soft_form(handle, &soft, Some(torn))
        .expect("exists");
    let reset = bench
        .scene
        .modify(handle, scene::Field::Dynamics, |object| {
            object.dynamics_reset = true;
        });
    reset.expect("exists");
    bench.run(1);
    let form = bench.scene.soft_form(handle).expect("it is soft");
    assert!(form.broken[3] && form.pressure == 0.0);
}

#[test]
fn cloths_make_no_new_plan_and_are_back_after_the_run() {
    let mut bench = Bench::new();
    let handle = bench.soft_body(
        &cloth(0.2, 3, [0.0, 0.0, 1.0]),
        &[pin(0, None, [-0.1, -0.1, 1.0])],
    );
    bench.scene.store_initial_state();
    let start = bench.points(handle);
    bench.run(20);
    assert_ne!(bench.points(handle), start);
    assert!(!bench.dynamics.has_new_changes(&bench.scene));
    bench.scene.restore_initial_state();
    assert_eq!(bench.points(handle), start);
}
