//! Highlights, shadows, edges, and objects beside each other.

use super::pictures::{SIDE, studio};
use super::*;

const MIDDLE: usize = SIDE / 2 * SIDE + SIDE / 2;

/// A black wall at 2 m that shines, under a lamp at the sensor.
fn glossy() -> (Studio, Handle) {
    let mut studio = studio();
    let mut wall =
        Shape::primitive(PrimitiveKind::Cuboid, [8.0, 8.0, 0.1], Default::default()).unwrap();
    let colour = &mut wall.parts[0].appearance.colour;
    (colour.ambient_diffuse, colour.specular) = ([0.0; 3], [0.5; 3]);
    let wall = studio.scene.add("wall", Kind::Shape(Box::new(wall)));
    let pose = Pose::translation(0.0, 0.0, 2.05);
    studio.scene.set_world_pose(wall.unwrap(), pose).unwrap();
    let light = Light::new(LightType::Directional);
    let light = studio.scene.add("light", Kind::Light(Box::new(light)));
    (studio, light.unwrap())
}

#[test]
fn highlights_are_seen_unless_a_sensor_or_a_light_has_none() {
    let image = |studio: &mut Studio| {
        let picture = studio
            .vision
            .sensor_picture(&studio.scene, studio.sensor, None);
        picture.unwrap().image.unwrap()[3 * MIDDLE]
    };
    let (mut studio, light) = glossy();
    assert!(image(&mut studio) > 20);
    let ignore =
        |object: &mut scene::Object| object.vision_sensor_mut().unwrap().ignore_specular = true;
    studio
        .scene
        .modify(studio.sensor, Field::Sensor, ignore)
        .unwrap();
    assert_eq!(image(&mut studio), 0);
    let (mut studio, light) = (glossy().0, light);
    let dull = |object: &mut scene::Object| {
        let Kind::Light(light) = &mut object.kind else {
            panic!("a light");
        };
        light.colour.specular = [0.0; 3];
    };
    studio.scene.modify(light, Field::Other, dull).unwrap();
    assert_eq!(image(&mut studio), 0);
}

/// The brightness of a wall behind a cube, as seen from the side, where the light is that of a lamp above the cube.
fn behind_a_cube(casts_shadows: bool, mode: RenderMode) -> u8 {
    let mut studio = studio();
    let mut wall =
        Shape::primitive(PrimitiveKind::Cuboid, [8.0, 8.0, 0.1], Default::default()).unwrap();
    let colour = &mut wall.parts[0].appearance.colour;
    (colour.ambient_diffuse, colour.specular) = ([1.0; 3], [0.0; 3]);
    let wall = studio.scene.add("wall", Kind::Shape(Box::new(wall)));
    let pose = Pose::translation(0.0, 0.0, 4.05);
    studio.scene.set_world_pose(wall.unwrap(), pose).unwrap();
    // Beside the line of sight, and on that of the light, which comes at 45 degrees.
    let cube = studio.cube(2.0);
    let pose = Pose::translation(2.0, 0.0, 2.0);
    studio.scene.set_world_pose(cube, pose).unwrap();
    let mut light = Light::new(LightType::Directional);
    light.casts_shadows = casts_shadows;
    let light = studio.scene.add("light", Kind::Light(Box::new(light)));
    let turn = Pose::new(
        [4.0, 0.0, 0.0].into(),
        [0.0, -std::f64::consts::FRAC_PI_4, 0.0].into(),
    );
    studio.scene.set_world_pose(light.unwrap(), turn).unwrap();
    studio
        .scene
        .modify_settings(|settings| settings.environment.ambient_light = [0.0; 3]);
    let change = |object: &mut scene::Object| {
        object.vision_sensor_mut().unwrap().render_mode = mode;
    };
    studio
        .scene
        .modify(studio.sensor, Field::Sensor, change)
        .unwrap();
    studio.picture().colour[3 * MIDDLE]
}

#[test]
fn shadows_fall_where_light_and_picture_have_them() {
    let with_shadows = RenderMode(5);
    assert!(with_shadows.has_shadows() && !RenderMode::OPENGL.has_shadows());
    // Half of the colour, times the cosine of 45 degrees.
    let lit = 90;
    for (casts_shadows, mode, expected) in [
        (true, RenderMode::OPENGL, lit),
        (false, with_shadows, lit),
        (true, with_shadows, 0),
    ] {
        let found = behind_a_cube(casts_shadows, mode);
        assert!(found.abs_diff(expected) < 3, "{found} is not {expected}");
    }
}

/// How many pixels of a red sheet of 0.5 m at 1 m are red and black.
fn red_and_black(change: impl FnOnce(&mut scene::shape::Appearance)) -> [usize; 2] {
    let mut studio = studio();
    let mut sheet =
        Shape::primitive(PrimitiveKind::Plane, [0.5, 0.5, 0.0], Default::default()).unwrap();
    let appearance = &mut sheet.parts[0].appearance;
    appearance.colour.emission = GLOW;
    (
        appearance.colour.ambient_diffuse,
        appearance.colour.specular,
    ) = ([0.0; 3], [0.0; 3]);
    change(appearance);
    let sheet = studio.scene.add("sheet", Kind::Shape(Box::new(sheet)));
    let sheet = sheet.unwrap();
    let pose = Pose::translation(0.0, 0.0, 1.0);
    studio.scene.set_world_pose(sheet, pose).unwrap();
    let picture = studio.picture();
    let count = |is_red: bool| {
        let pixels = picture.colour.as_chunks::<3>().0.iter().zip(&picture.ids);
        let of_sheet = pixels.filter(|(_, id)| **id == sheet.0);
        of_sheet
            .filter(|(pixel, _)| (pixel[0] > 100) == is_red)
            .count()
    };
    [count(true), count(false)]
}

#[test]
fn edges_are_drawn_as_the_shape_has_them() {
    let [all, black] = red_and_black(|_| ());
    assert!(all > 500 && black == 0, "{all} {black}");
    let [red, black] = red_and_black(|appearance| appearance.edges = true);
    // A border around some 30 pixels by 30, a pixel or two wide.
    assert!((80..260).contains(&black) && red > 500, "{red} {black}");
    let hidden = red_and_black(|appearance| {
        (appearance.edges, appearance.edge_borders_hidden) = (true, true);
    });
    assert_eq!(hidden, [all, 0]);
    let [wire, _] = red_and_black(|appearance| appearance.wireframe = true);
    assert!((30..all / 2).contains(&wire), "{wire} of {all}");
}

#[test]
fn objects_in_pixels_beside_each_other_are_both_seen() {
    let mut studio = Studio::new();
    let cubes = [studio.cube(2.0), studio.cube(2.0)];
    for (cube, x) in cubes.into_iter().zip([0.3, -0.3]) {
        let pose = Pose::translation(x, 0.0, 2.0);
        studio.scene.set_world_pose(cube, pose).unwrap();
    }
    let change = |object: &mut scene::Object| {
        let sensor = object.vision_sensor_mut().unwrap();
        sensor.render_mode = RenderMode::HANDLES;
        sensor.view.set_resolution([2, 1]);
    };
    studio
        .scene
        .modify(studio.sensor, Field::Sensor, change)
        .unwrap();
    let picture = studio
        .vision
        .sensor_picture(&studio.scene, studio.sensor, None);
    assert_eq!(picture.unwrap().seen.as_deref(), Some(&cubes[..]));
}
