//! Pictures of small scenes, and what is kept between them.

mod items;
mod kept;
mod pictures;
mod sensors;
mod surfaces;
mod views;
mod voxels;

use geometry::PrimitiveKind;
use rendering::Channels;

use super::{Picture, Vision};
use scene::appearance::texture::Texture;
use scene::appearance::texture_mapping::{ApplyMode, TextureMapping, TextureSource};
use scene::object::viewers::Viewers;
use scene::sensor::{Light, LightType, RenderMode, VisionOptions, VisionSensor};
use scene::shape::Shape;
use scene::voxels::octree::{OcTree, Voxel};
use scene::{CollectionItem, CopyOptions, Field, Handle, ItemOptions, Kind, Members, Pose, Scene};

const GLOW: [f32; 3] = [1.0, 0.0, 0.0];

/// A scene with a sensor at its origin that looks along z.
struct Studio {
    scene: Scene,
    sensor: Handle,
    vision: Vision,
}

impl Studio {
    fn new() -> Self {
        let mut scene = Scene::new();
        let options = VisionOptions::PERSPECTIVE | VisionOptions::OWN_BACKGROUND;
        let floats = [0.1, 10.0, 1.0, 0.01, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let sensor = VisionSensor::new(options, [9, 9], Some(floats));
        let sensor = scene
            .add("eye", Kind::VisionSensor(Box::new(sensor)))
            .unwrap();
        Self {
            scene,
            sensor,
            vision: Vision::default(),
        }
    }

    /// A cube of half a metre in front of the sensor, which glows.
    fn cube(&mut self, z: f64) -> Handle {
        let mut shape =
            Shape::primitive(PrimitiveKind::Cuboid, [0.5; 3], Default::default()).unwrap();
        shape.parts[0].appearance.colour.emission = GLOW;
        shape.parts[0].appearance.colour.ambient_diffuse = [0.0; 3];
        shape.parts[0].appearance.colour.specular = [0.0; 3];
        let cube = self
            .scene
            .add("cube", Kind::Shape(Box::new(shape)))
            .unwrap();
        self.scene
            .set_world_pose(cube, Pose::translation(0.0, 0.0, z))
            .unwrap();
        cube
    }

    fn picture(&mut self) -> Picture {
        self.vision
            .view(&self.scene, Some(self.sensor), None, Channels::ALL)
            .unwrap()
    }

    /// Colour, depth in metres and object in the middle of the picture.
    fn middle(&mut self) -> ([u8; 3], f32, Option<Handle>) {
        let picture = self.picture();
        let id = Some(picture.ids[40]).filter(|id| *id != Picture::NOTHING);
        let colour = [
            picture.colour[120],
            picture.colour[121],
            picture.colour[122],
        ];
        (colour, 0.1 + 9.9 * picture.depth[40], id.map(Handle))
    }
}

#[test]
fn what_changes_is_seen() {
    let mut studio = Studio::new();
    assert_eq!(studio.middle().2, None);
    let cube = studio.cube(2.0);
    let (colour, depth, id) = studio.middle();
    assert!(
        (depth - 1.75).abs() < 1e-5 && colour == [255, 0, 0] && id == Some(cube),
        "{colour:?} {depth} {id:?}"
    );
    studio
        .scene
        .modify(cube, Field::Appearance, |object| {
            object.shape_mut().unwrap().parts[0]
                .appearance
                .colour
                .emission = [0.0, 1.0, 0.0];
        })
        .unwrap();
    studio
        .scene
        .set_world_pose(cube, Pose::translation(0.0, 0.0, 3.0))
        .unwrap();
    let (colour, depth, _) = studio.middle();
    assert!(
        (depth - 2.75).abs() < 1e-5 && colour == [0, 255, 0],
        "{colour:?} {depth}"
    );
    studio.scene.remove(&[cube]).unwrap();
    assert_eq!(studio.middle().2, None);
    let other = studio.cube(4.0);
    assert_eq!(studio.middle().2, Some(other));
}

#[test]
fn copies_share_what_is_prepared() {
    let mut studio = Studio::new();
    let cube = studio.cube(2.0);
    let copy = studio
        .scene
        .copy_objects(&[cube], CopyOptions::empty())
        .unwrap()[&cube];
    studio.picture();
    assert_eq!(studio.vision.models.prepared_meshes(), 1);
    studio.scene.remove(&[cube]).unwrap();
    studio.picture();
    assert_eq!(studio.vision.models.prepared_meshes(), 1);
    studio.scene.remove(&[copy]).unwrap();
    studio.picture();
    assert_eq!(studio.vision.models.prepared_meshes(), 0);
}

#[test]
fn images_are_on_what_they_belong_to() {
    let mut studio = Studio::new();
    let cube = studio.cube(2.0);
    let id = studio
        .scene
        .textures_mut()
        .add(Texture::new("blue", [1, 1], false, &[0, 0, 255]).unwrap())
        .unwrap();
    let decal = |source| {
        Some(TextureMapping {
            apply_mode: ApplyMode::DECAL,
            ..TextureMapping::new(source)
        })
    };
    studio
        .scene
        .set_shape_texture(cube, decal(TextureSource::Texture(id)))
        .unwrap();
    assert_eq!(studio.middle().0, [0, 0, 255]);
    let screen = VisionSensor::new(VisionOptions::empty(), [1, 1], None);
    let screen = studio
        .scene
        .add("screen", Kind::VisionSensor(Box::new(screen)))
        .unwrap();
    studio
        .scene
        .set_shape_texture(cube, decal(TextureSource::Sensor(screen)))
        .unwrap();
    assert_eq!(studio.middle().0, [0, 0, 0]);
    let shows =
        |object: &mut scene::Object| object.vision_sensor_mut().unwrap().image = vec![9, 8, 7];
    studio.scene.modify(screen, Field::Measured, shows).unwrap();
    assert_eq!(studio.middle().0, [9, 8, 7]);
}

#[test]
fn voxels_are_cubes_without_inner_faces() {
    let mut studio = Studio::new();
    let mut octree = OcTree::new(0.5, 1.0);
    for (at, red) in [(0.25, 10), (0.75, 20)] {
        octree.insert(
            [0.25, 0.25, at],
            Voxel {
                colour: [red, 0, 0],
                tag: 0,
            },
        );
    }
    let octree = studio
        .scene
        .add("octree", Kind::OcTree(Box::new(octree)))
        .unwrap();
    studio
        .scene
        .set_world_pose(octree, Pose::translation(-0.25, -0.25, 2.0))
        .unwrap();
    studio
        .scene
        .modify_settings(|settings| settings.environment.ambient_light = [1.0; 3]);
    let (colour, depth, id) = studio.middle();
    assert!(
        (depth - 2.0).abs() < 1e-5 && colour == [10, 0, 0] && id == Some(octree),
        "{colour:?} {depth}"
    );
}

#[test]
fn lights_that_are_not_attached_do_not_count_where_only_those_do() {
    let mut studio = Studio::new();
    let cube = studio.cube(2.0);
    let appearance = |object: &mut scene::Object| {
        let colour = &mut object.shape_mut().unwrap().parts[0].appearance.colour;
        (colour.emission, colour.ambient_diffuse) = ([0.0; 3], [1.0; 3]);
    };
    studio
        .scene
        .modify(cube, Field::Appearance, appearance)
        .unwrap();
    studio
        .scene
        .modify_settings(|settings| settings.environment.ambient_light = [0.0; 3]);
    let light = studio
        .scene
        .add(
            "light",
            Kind::Light(Box::new(Light::new(LightType::Directional))),
        )
        .unwrap();
    assert_eq!(studio.middle().0, [128; 3]);
    let local =
        |object: &mut scene::Object| object.vision_sensor_mut().unwrap().local_lights = true;
    studio
        .scene
        .modify(studio.sensor, Field::Sensor, local)
        .unwrap();
    assert_eq!(studio.middle().0, [0; 3]);
    studio
        .scene
        .set_parent(light, Some(studio.sensor), true)
        .unwrap();
    assert_eq!(studio.middle().0, [128; 3]);
}

#[test]
fn handles_are_listed_once_each() {
    let mut studio = Studio::new();
    let cubes = [studio.cube(2.0), studio.cube(2.4)];
    let mode = |object: &mut scene::Object| {
        object.vision_sensor_mut().unwrap().render_mode = RenderMode::HANDLES;
    };
    studio
        .scene
        .modify(studio.sensor, Field::Sensor, mode)
        .unwrap();
    studio
        .scene
        .set_world_pose(cubes[1], Pose::translation(0.6, 0.0, 2.0))
        .unwrap();
    let picture = studio
        .vision
        .sensor_picture(&studio.scene, studio.sensor, None)
        .unwrap();
    assert_eq!(picture.seen.as_deref(), Some(&cubes[..]));
    let image = picture.image.unwrap();
    assert_eq!(image[120..123], [cubes[0].0 as u8, 0, 0]);
    assert!(
        studio
            .vision
            .sensor_picture(&studio.scene, cubes[0], None)
            .is_err()
    );
}

#[test]
fn objects_are_seen_by_their_viewers_only() {
    let mut studio = Studio::new();
    let cube = studio.cube(2.0);
    let (scene, sensor) = (&mut studio.scene, studio.sensor);
    let other = scene.add(
        "other",
        Kind::VisionSensor(Box::new(VisionSensor::new(
            VisionOptions::empty(),
            [1, 1],
            None,
        ))),
    );
    let other = other.unwrap();
    let collection = scene.collections_mut().add(false, None);
    let item = CollectionItem::new(Members::Single(sensor), ItemOptions::empty());
    scene
        .collections_mut()
        .get_mut(collection)
        .unwrap()
        .items
        .push(item);
    let cases = [
        (Viewers::All, [true, true]),
        (Viewers::None, [false, false]),
        (Viewers::One(sensor), [true, false]),
        (Viewers::One(other), [false, false]),
        (Viewers::Collection(collection), [true, false]),
        (Viewers::Collection(1), [false, false]),
    ];
    for (viewers, [by_sensor, from_elsewhere]) in cases {
        studio
            .scene
            .modify(cube, Field::Other, |object| object.viewers = viewers)
            .unwrap();
        let elsewhere = studio
            .vision
            .view(&studio.scene, None, Some([64, 64]), Channels::IDS)
            .unwrap();
        assert_eq!(studio.middle().2.is_some(), by_sensor, "{viewers:?}");
        assert_eq!(
            elsewhere.ids.contains(&cube.0),
            from_elsewhere,
            "{viewers:?}"
        );
    }
    studio
        .scene
        .modify(cube, Field::Other, |object| {
            object.viewers = Viewers::One(other);
        })
        .unwrap();
    let copies = studio
        .scene
        .copy_objects(&[other, cube], CopyOptions::empty())
        .unwrap();
    assert_eq!(
        studio.scene.object(copies[&cube]).unwrap().viewers,
        Viewers::One(copies[&other])
    );
    studio.scene.remove(&[other]).unwrap();
    assert_eq!(studio.scene.object(cube).unwrap().viewers, Viewers::All);
}

#[test]
fn without_a_camera_all_is_in_view() {
    let mut studio = Studio::new();
    let size = Some([64, 64]);
    let empty = studio
        .vision
        .view(&studio.scene, None, size, Channels::ALL)
        .unwrap();
    assert!(empty.ids.iter().all(|id| *id == Picture::NOTHING));
    let cubes = [studio.cube(2.0), studio.cube(-700.0)];
    let picture = studio
        .vision
        .view(&studio.scene, None, size, Channels::IDS)
        .unwrap();
    studio
        .scene
        .set_world_pose(cubes[1], Pose::translation(0.0, 5.0, 2.0))
        .unwrap();
    let near = studio
        .vision
        .view(&studio.scene, None, size, Channels::IDS)
        .unwrap();
    assert!(cubes.iter().all(|cube| near.ids.contains(&cube.0)));
    assert_eq!(picture.ids.len(), 64 * 64);
    assert!(
        studio
            .vision
            .view(&studio.scene, Some(cubes[0]), size, Channels::IDS)
            .is_err()
    );
}
