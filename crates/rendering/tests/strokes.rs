//! Points, lines, edges and wire frames, in numbers.

mod common;

use common::*;
use geometry::Pose;
use rendering::{Channels, Edges, Lines, Material, Mesh, Points, Renderer, World};

#[test]
fn points_are_squares_and_lines_have_a_width() {
    let colours = [[1.0, 0.0, 0.0]];
    let points = Points {
        positions: &[[0.0, 0.0, 2.0]],
        colours: &colours,
        pose: Pose::identity(),
        size: 4.0,
        id: 3,
        overlay: false,
    };
    let lines = Lines {
        segments: &[[[-9.0, 0.5, 2.0], [9.0, 0.5, 2.0]]],
        colours: &colours,
        pose: Pose::identity(),
        width: 3.0,
        id: 4,
        overlay: false,
    };
    let (wall, grey) = (rectangle(40.0, 40.0, 3.0), Material::unlit([0.5; 3]));
    let picture = |z: f64, overlay: bool| {
        let instances = [at(instance(&wall, &grey, 1), 0.0, 0.0, z)];
        let (points, lines) = ([Points { overlay, ..points }], [Lines { overlay, ..lines }]);
        let world = World {
            instances: &instances,
            points: &points,
            lines: &lines,
            ..World::EMPTY
        };
        Renderer::new(1).render(&world, &camera(100, 100), Channels::ALL)
    };
    let visible = picture(0.0, false);
    assert_eq!((count(&visible, 3), count(&visible, 4)), (16, 300));
    assert_eq!(colour_at(&visible, 50, 50), [255, 0, 0]);
    assert!((depth_at(&visible, 50, 50) - (1.99 / 9.99) as f32).abs() < 1e-7);
    assert_eq!(count(&picture(-1.5, false), 1), 10_000);
    assert_eq!(picture(-1.5, true).ids, visible.ids);
}

#[test]
fn sharp_edges_are_drawn_and_wire_frames_are_hollow() {
    let cube = cuboid([1.0; 3]);
    let edges = Some(Edges {
        angle: 0.5,
        borders: true,
        colour: [0.0; 3],
        width: 1.0,
    });
    let (plain, edged) = (
        Material::unlit([1.0; 3]),
        Material {
            edges,
            ..Material::unlit([1.0; 3])
        },
    );
    let wire = Material {
        wireframe: true,
        ..Material::unlit([1.0; 3])
    };
    let draw = |material: &Material| {
        let mut cube = at(instance(&cube, material, 7), 0.0, 0.0, 3.0);
        cube.pose.rotation = nalgebra::UnitQuaternion::from_euler_angles(0.5, 0.6, 0.1);
        render(&[cube], &camera(200, 200))
    };
    let (plain, edged, wire) = (draw(&plain), draw(&edged), draw(&wire));
    // Colours show edges, depths and ids do not; diagonals of faces are no edges.
    assert_eq!((&plain.ids, &plain.depth), (&edged.ids, &edged.depth));
    let black = edged
        .colour
        .iter()
        .zip(&plain.colour)
        .filter(|(edged, plain)| edged < plain)
        .count()
        / 3;
    assert!((200..700).contains(&black), "{black}");
    assert!(count(&wire, 7) > black && count(&wire, 7) < count(&plain, 7) / 3);
}

#[test]
fn edges_are_drawn_by_angle_border_and_visibility() {
    let draw = |mesh: &Mesh, z: f64, edges: Edges| {
        let white = Material {
            edges: Some(edges),
            ..Material::unlit([1.0; 3])
        };
        let (behind, plain) = (rectangle(40.0, 40.0, 9.0), Material::unlit([1.0; 3]));
        let instances = [
            at(instance(mesh, &white, 7), 0.0, 0.0, z),
            instance(&behind, &plain, 1),
        ];
        render(&instances, &camera(200, 200))
            .colour
            .chunks(3)
            .filter(|colour| colour[0] == 0)
            .count()
    };
    let edges = Edges {
        angle: 0.5,
        borders: true,
        colour: [0.0; 3],
        width: 1.0,
    };
    let wall = rectangle(1.0, 1.0, 0.0);
    // A side of the wall is 87 pixels long; a limit of zero shows the diagonal too.
    let (sides, all) = (
        draw(&wall, 2.0, edges),
        draw(
            &wall,
            2.0,
            Edges {
                angle: 0.0,
                ..edges
            },
        ),
    );
    assert!(
        (120..=350).contains(&sides) && (80..=90).contains(&(all - sides)),
        "{sides} {all}"
    );
    assert_eq!(
        draw(
            &wall,
            2.0,
            Edges {
                borders: false,
                ..edges
            }
        ),
        0
    );
    // A box of 16 pixels, 90 pixels deep: its far edges are hidden.
    let (of_box, of_front) = (
        draw(&cuboid([0.5, 0.5, 3.0]), 7.0, edges),
        draw(&rectangle(0.5, 0.5, -1.5), 7.0, edges),
    );
    assert!(of_front > 10 && of_box == of_front, "{of_box} {of_front}");
}
