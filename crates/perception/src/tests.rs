//! Queries of whole scenes against one object after the other, and perception that is kept against perception that is new.

mod bodies;
mod faces;
mod pairs;
mod queries;
mod rays;

use geometry::PrimitiveKind;
use nalgebra::{Translation3, UnitQuaternion, Vector3};
use rand_mt::Mt;

use super::Perception;
use super::detection::{Detected, DetectionMode};
use super::distance::Shortest;
use super::entity::{Entity, Purpose};
use scene::object::dummy::Dummy;
use scene::sensor::volume::VolumeType;
use scene::sensor::{ProximityOptions, ProximitySensor};
use scene::shape::Shape;
use scene::shape::options::PrimitiveOptions;
use scene::voxels::octree::{OcTree, Voxel};
use scene::{Field, Handle, Kind, Pose, Scene};

/// A cube of 0.2 m at x.
pub(super) fn cuboid(scene: &mut Scene, x: f64) -> Handle {
    primitive(
        scene,
        PrimitiveKind::Cuboid,
        [0.2; 3],
        Pose::translation(x, 0.0, 0.0),
    )
}

fn primitive(scene: &mut Scene, kind: PrimitiveKind, size: [f64; 3], pose: Pose) -> Handle {
    let shape = Shape::primitive(kind, size, PrimitiveOptions::empty()).unwrap();
    let handle = scene.add("shape", Kind::Shape(Box::new(shape))).unwrap();
    scene.set_world_pose(handle, pose).unwrap();
    handle
}

fn sensor(scene: &mut Scene, volume_type: VolumeType) -> Handle {
    let floats = [
        0.0, 3.0, 0.2, 0.2, 1.0, 1.0, 0.0, 0.05, 0.5, 1.2, 0.0, 0.0, 0.01, 0.0, 0.0,
    ];
    let options = ProximityOptions::empty();
    let sensor = ProximitySensor::new(
        volume_type,
        options,
        ProximitySensor::INTEGERS,
        Some(floats),
    );
    scene
        .add("sensor", Kind::ProximitySensor(Box::new(sensor)))
        .unwrap()
}

struct Dice(Mt);

impl Dice {
    fn number(&mut self) -> f64 {
        f64::from(self.0.next_u32()) / 4_294_967_296.0
    }

    fn below(&mut self, end: usize) -> usize {
        (self.number() * end as f64) as usize
    }

    fn pose(&mut self) -> Pose {
        let [x, y, z, a, b, c] = std::array::from_fn(|_| 2.0 * self.number() - 1.0);
        Pose::from_parts(
            Translation3::new(x, y, z),
            UnitQuaternion::new(Vector3::new(a, b, c)),
        )
    }
}

/// Shapes of several kinds, an octree and a dummy, some of them below others.
fn populate(scene: &mut Scene, dice: &mut Dice) -> Vec<Handle> {
    let kinds = [
        PrimitiveKind::Cuboid,
        PrimitiveKind::Spheroid,
        PrimitiveKind::Cylinder,
        PrimitiveKind::Cone,
    ];
    let mut handles: Vec<Handle> = (0..24)
        .map(|i| {
            primitive(
                scene,
                kinds[i % 4],
                [0.1 + 0.2 * dice.number(), 0.2, 0.3],
                dice.pose(),
            )
        })
        .collect();
    let mut tree = OcTree::new(0.1, 1.0);
    (0..20).for_each(|_| {
        tree.insert(
            [0; 3].map(|_| dice.number()),
            Voxel {
                colour: [0; 3],
                tag: 0,
            },
        );
    });
    handles.push(scene.add("octree", Kind::OcTree(Box::new(tree))).unwrap());
    handles.push(scene.add("dummy", Kind::Dummy(Dummy::new(0.01))).unwrap());
    for i in (2..20).step_by(3) {
        scene
            .set_parent(handles[i], Some(handles[i - 1]), true)
            .unwrap();
    }
    handles
}

fn detect(
    perception: &mut Perception,
    scene: &Scene,
    sensor: Handle,
    entity: Entity,
) -> Option<Detected> {
    let mode = DetectionMode::of(scene.object(sensor).unwrap().proximity_sensor().unwrap());
    let group = entity.group(scene, Purpose::Detection);
    perception.detect(scene, sensor, &group, mode).unwrap()
}

/// Results of `ask` for all other objects, one after the other.
fn one_by_one<R>(
    scene: &Scene,
    purpose: Purpose,
    mut ask: impl FnMut(Handle) -> Option<R>,
) -> Vec<R> {
    let others = Entity::All.objects(scene, purpose);
    others.into_iter().filter_map(&mut ask).collect()
}

fn nearest<R>(found: Vec<R>, distance: impl Fn(&R) -> f64) -> Option<R> {
    found
        .into_iter()
        .reduce(|a, b| if distance(&b) < distance(&a) { b } else { a })
}

#[test]
fn everything_at_once_is_the_nearest_of_one_after_the_other() {
    let mut dice = Dice(Mt::new(1));
    let (mut scene, mut perception) = (Scene::new(), Perception::new(0, None));
    populate(&mut scene, &mut dice);
    let types = [
        VolumeType::Ray,
        VolumeType::Cone,
        VolumeType::Pyramid,
        VolumeType::Cylinder,
        VolumeType::Disc,
    ];
    let sensors = types.map(|volume_type| sensor(&mut scene, volume_type));
    let mut detections = 0;
    for round in 0..60 {
        let sensor = sensors[round % sensors.len()];
        scene.set_world_pose(sensor, dice.pose()).unwrap();
        let all = detect(&mut perception, &scene, sensor, Entity::All);
        let single = one_by_one(&scene, Purpose::Detection, |object| {
            detect(&mut perception, &scene, sensor, Entity::Object(object))
        });
        let expected = nearest(single, |found| found.distance);
        assert_eq!(
            all.map(|found| found.distance),
            expected.map(|found| found.distance),
            "{round}"
        );
        detections += usize::from(all.is_some());
    }
    assert!((20..60).contains(&detections), "{detections}");
}

#[test]
fn distances_and_collisions_are_those_of_one_after_the_other() {
    let mut dice = Dice(Mt::new(2));
    let (mut scene, mut perception) = (Scene::new(), Perception::new(0, None));
    let objects = populate(&mut scene, &mut dice);
    let mut collisions = 0;
    for &object in &objects {
        let entity = Entity::Object(object);
        let all = perception.distance(&scene, [entity, Entity::All], f64::INFINITY);
        let others = one_by_one(&scene, Purpose::Distance, |other| {
            perception.distance(&scene, [entity, Entity::Object(other)], f64::INFINITY)
        });
        let distance = |found: &Shortest| found.distance;
        assert_eq!(
            all.as_ref().map(distance),
            nearest(others, distance).as_ref().map(distance)
        );
        let first = perception.collision(&scene, [entity, Entity::All]);
        let others = one_by_one(&scene, Purpose::Collision, |other| {
            perception.collision(&scene, [entity, Entity::Object(other)])
        });
        assert_eq!(first, others.first().copied());
        collisions += usize::from(first.is_some());
    }
    assert!((1..objects.len()).contains(&collisions), "{collisions}");
}

/// Objects move, come, go, get other parents and other geometries; the index follows the journal.
#[test]
fn an_index_that_follows_answers_as_a_new_one() {
    let mut dice = Dice(Mt::new(3));
    let (mut scene, mut kept) = (Scene::new(), Perception::new(0, None));
    let mut objects = populate(&mut scene, &mut dice);
    let sensors =
        [VolumeType::Ray, VolumeType::Cone].map(|volume_type| sensor(&mut scene, volume_type));
    for round in 0..150 {
        change(&mut scene, &mut objects, &mut dice);
        let sensor = sensors[round % 2];
        scene.set_world_pose(sensor, dice.pose()).unwrap();
        let mut new = Perception::new(0, None);
        let entity = Entity::Object(objects[dice.below(objects.len())]);
        let answers = [&mut kept, &mut new].map(|perception| {
            (
                detect(perception, &scene, sensor, Entity::All),
                perception
                    .distance(&scene, [entity, Entity::All], f64::INFINITY)
                    .map(|found| found.distance),
                perception.collision(&scene, [entity, Entity::All]),
                perception
                    .intersections(&scene, [entity, Entity::All])
                    .len(),
            )
        });
        assert_eq!(answers[0], answers[1], "{round}");
    }
}

fn change(scene: &mut Scene, objects: &mut Vec<Handle>, dice: &mut Dice) {
    let at = dice.below(objects.len());
    let object = objects[at];
    match dice.below(9) {
        5..=7 => grow_octrees(scene, dice),
        0 => {
            scene.remove(&[object]).unwrap();
            objects.remove(at);
        }
        1 => objects.push(primitive(
            scene,
            PrimitiveKind::Spheroid,
            [0.3; 3],
            dice.pose(),
        )),
        // It may be below that other object already, or above it.
        2 => drop(scene.set_parent(
            object,
            Some(objects[dice.below(objects.len())]),
            dice.number() < 0.5,
        )),
        3 => {
            let tessellated =
                Shape::primitive(PrimitiveKind::Cuboid, [0.4; 3], PrimitiveOptions::empty())
                    .unwrap();
            // Only shapes have another shape.
            let _ = scene.morph_shape(object, tessellated);
        }
        4 => scene
            .scale_objects(&[object], 1.1, true)
            .unwrap_or_default(),
        _ => scene.set_world_pose(object, dice.pose()).unwrap(),
    }
}

/// More voxels for each octree, or fewer.
fn grow_octrees(scene: &mut Scene, dice: &mut Dice) {
    let is_octree = |object: &&scene::Object| object.octree().is_ok();
    let octrees: Vec<Handle> = scene
        .objects()
        .filter(is_octree)
        .map(scene::Object::handle)
        .collect();
    let (voxel, goes) = (
        Voxel {
            colour: [0; 3],
            tag: 0,
        },
        dice.below(8) == 0,
    );
    for octree in octrees {
        let points: Vec<[f64; 3]> = (0..1 + dice.below(3))
            .map(|_| dice.pose().translation.vector.into())
            .collect();
        let grow = |object: &mut scene::Object| {
            let tree = object.octree_mut().unwrap();
            for point in points {
                match goes {
                    true => tree.remove(point),
                    false => tree.insert(point, voxel),
                }
            }
        };
        scene.modify(octree, Field::Geometry, grow).unwrap();
    }
}

#[test]
fn an_octree_that_grows_is_prepared_in_few_parts() {
    let mut scene = Scene::new();
    let tree = Kind::OcTree(Box::new(OcTree::new(0.1, 1.0)));
    let octree = scene.add("octree", tree).unwrap();
    let mut index = crate::index::Index::default();
    for number in 0..300_u32 {
        let point = [0.1 * f64::from(number) + 0.05, 0.0, 0.0];
        let voxel = Voxel {
            colour: [0; 3],
            tag: 0,
        };
        let insert = |object: &mut scene::Object| object.octree_mut().unwrap().insert(point, voxel);
        scene.modify(octree, Field::Geometry, insert).unwrap();
        index.update(&scene);
        let parts = index.body(octree).unwrap().parts().count();
        // Each has more voxels than all behind it together, and there is no smaller one to join: as the ones of a binary number.
        assert_eq!(parts, (number + 1_u32).count_ones() as usize, "{number}");
    }
}

#[test]
fn nothing_is_stored_before_the_first_query_and_nothing_breaks_without_geometry() {
    let mut scene = Scene::new();
    let flat = cuboid(&mut scene, 0.0);
    let mesh = geometry::Mesh {
        vertices: vec![[0.0; 3]; 3],
        triangles: vec![[0, 1, 2]],
        normals: vec![[0.0; 3]; 3],
    };
    let flatten = |object: &mut scene::Object| {
        object.shape_mut().unwrap().parts[0].mesh = std::rc::Rc::new(mesh);
    };
    scene.modify(flat, Field::Geometry, flatten).unwrap();
    let empty = scene
        .add("octree", Kind::OcTree(Box::new(OcTree::new(0.1, 1.0))))
        .unwrap();
    let other = cuboid(&mut scene, 0.0);
    let mut perception = Perception::new(0, None);
    assert!(!scene.journal().is_followed(scene::Topic::Added));
    for object in [flat, empty] {
        let entities = [Entity::Object(object), Entity::Object(other)];
        assert_eq!(perception.distance(&scene, entities, f64::INFINITY), None);
        assert_eq!(perception.collision(&scene, entities), None);
    }
    assert!(scene.journal().is_followed(scene::Topic::Added));
}

#[test]
fn random_rays_are_those_of_the_seed() {
    let mut scene = Scene::new();
    let ray = sensor(&mut scene, VolumeType::Ray);
    scene
        .modify(ray, Field::Sensor, |object| {
            let data = object.proximity_sensor_mut().unwrap();
            (data.randomized, data.samples, data.required_samples) = (true, 20, 3);
        })
        .unwrap();
    primitive(
        &mut scene,
        PrimitiveKind::Plane,
        [10.0, 10.0, 0.0],
        Pose::translation(0.0, 0.0, 1.0),
    );
    let read = |seed: u32| {
        let mut perception = Perception::new(seed, None);
        [0; 3].map(|_| {
            detect(&mut perception, &scene, ray, Entity::All)
                .unwrap()
                .distance
        })
    };
    let distances = read(7);
    assert_eq!(distances, read(7));
    assert!(distances != read(8) && distances[0] != distances[1]);
    // Rays in a cone of 1.2 rad to a plane at 1 m.
    assert!(
        distances
            .iter()
            .all(|distance| (1.0..1.0 / 0.6_f64.cos()).contains(distance)),
        "{distances:?}"
    );
}
