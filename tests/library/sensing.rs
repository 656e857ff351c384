//! Sensors and calculation objects as scripts use them: objects of old scenes, large pictures, odd poses, random rays.

use std::path::Path;

use geometry::PrimitiveKind;
use swanilda::scene::shape::Shape;
use swanilda::scene::tree::calculation_objects::CalculationObject;
use swanilda::scene::{Data, Handle, Kind, Pose, special};
use swanilda::{Options, SceneFile, ScriptKind, ScriptRef, Simulator};

/// Runs a chunk of the sandbox, which must not fail.
#[track_caller]
fn run(sim: &mut Simulator, code: &str) -> ScriptRef {
    match sim.add_script(ScriptKind::Sandbox, "test", code.as_bytes()) {
        Ok(script) => script,
        Err(error) => panic!("{error}"),
    }
}

fn simulator() -> Simulator {
    Simulator::new(Options::default())
}

fn cube(sim: &mut Simulator, x: f64) -> Handle {
    let shape =
        Shape::primitive(PrimitiveKind::Cuboid, [0.2; 3], Default::default()).expect("a size");
    let cube = sim
        .scene_mut()
        .add("cube", Kind::Shape(Box::new(shape)))
        .expect("there is room");
    sim.scene_mut()
        .set_world_pose(cube, Pose::translation(x, 0.0, 0.0))
        .expect("a place");
    cube
}

fn object<R>(name: &str, entities: [i64; 2], threshold: f64) -> CalculationObject<R> {
    CalculationObject {
        name: name.into(),
        persistent_uid: "id".into(),
        entities,
        threshold,
        explicit: false,
        switches: 3,
        result: None,
    }
}

/// A file with three cubes at 0, 1 and 3, two collision objects and three distance objects.
fn old_scene(path: &Path) {
    let mut sim = simulator();
    let [a, b, c] = [0.0, 1.0, 3.0].map(|x| cube(&mut sim, x).raw());
    let mut scene = sim.scene_mut();
    scene
        .collision_objects_mut()
        .add(object("bump", [a, b], 0.0));
    scene
        .collision_objects_mut()
        .add(object("any", [c, special::ALL], 0.0));
    for (name, entities, threshold) in [
        ("gap", [a, b], 0.0),
        ("near", [b, c], 0.5),
        ("rest", [c, special::ALL], 0.0),
    ] {
        scene
            .distance_objects_mut()
            .add(object(name, entities, threshold));
    }
    drop(scene);
    let path = Data::text(path.to_str().expect("a name in UTF-8"));
    sim.call_api("sim.saveScene", &[path])
        .expect("the scene is saved");
}

#[test]
fn collision_and_distance_objects_of_files_are_computed_by_the_main_script() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("old.ttt");
    old_scene(&path);
    let mut sim = simulator();
    sim.load(SceneFile::read(&std::fs::read(&path).unwrap()).unwrap())
        .unwrap();
    run(
        &mut sim,
        "near = function(a, b) return math.abs(a - b) < 1e-7 end
        a, b, c = table.unpack(sim.getObjectsInTree(sim.handle_scene))
        bump, any = sim.getCollisionHandle('bump'), sim.getCollisionHandle('any#')
        gap, close, rest = sim.getDistanceHandle('gap'), sim.getDistanceHandle('near'), sim.getDistanceHandle('rest')
        assert(bump == 2010001 and any == 2010002 and gap == 2020002 and rest == 2020004)
        assert(select('#', sim.readCollision(bump)) == 1 and sim.readCollision(bump) == 0)
        assert(sim.readDistance(gap) == 0)",
    );
    sim.step(1);
    run(
        &mut sim,
        "local result, distance = sim.readDistance(gap)
        assert(result == 1 and near(distance, 0.8), distance)
        assert(sim.readDistance(close) == 0)
        assert(near(select(2, sim.readDistance(rest)), 1.8) and sim.readCollision(bump) == 0)
        sim.setObjectPosition(b, {0.1, 0, 0})",
    );
    sim.step(1);
    run(
        &mut sim,
        "local result, pair = sim.readCollision(bump)
        assert(result == 1 and pair[1] == a and pair[2] == b)
        assert(near(select(2, sim.readDistance(gap)), 0))
        assert(sim.handleCollision(sim.handle_all) == 1 and near(select(2, sim.handleDistance(sim.handle_all)), 0))
        local ok, e = pcall(sim.handleCollision, bump)
        assert(not ok and e:find('object not tagged for explicit handling.', 1, true), e)
        assert(sim.resetDistance(sim.handle_all) == 1 and sim.readDistance(gap) == 0)
        sim.setExplicitHandling(bump, 1)
        assert(sim.getExplicitHandling(bump) == 1 and sim.getExplicitHandling(gap) == 0)
        assert(sim.resetCollision(bump) == 1 and sim.readCollision(bump) == 0)
        assert(sim.handleCollision(bump) == 1 and sim.handleCollision(sim.handle_all_except_explicit) == 0)
        sim.removeObjects({c})
        assert(sim.getCollisionHandle('any@silentError') == -1 and sim.getDistanceHandle('near@silentError') == -1)
        for _, call in ipairs{sim.readCollision, sim.handleCollision, sim.resetCollision} do
            local ok, e = pcall(call, any)
            assert(not ok and e:find('collision object does not exist.', 1, true), e)
        end
        for _, call in ipairs{sim.readDistance, sim.handleDistance, sim.resetDistance} do
            local ok, e = pcall(call, rest)
            assert(not ok and e:find('distance object does not exist.', 1, true), e)
        end",
    );
    sim.stop();
    run(
        &mut sim,
        "assert(sim.readDistance(gap) == 0 and sim.readCollision(bump) == 1)",
    );
    assert_eq!(sim.errors(), 0);
    assert_eq!(
        sim.scene()
            .collision_objects()
            .iter()
            .next()
            .unwrap()
            .1
            .switches,
        3
    );
}

#[test]
fn calculations_that_a_scene_switches_off_find_nothing() {
    let mut sim = simulator();
    let [a, b] = [0.0, 0.1].map(|x| cube(&mut sim, x).raw());
    sim.scene_mut()
        .collision_objects_mut()
        .add(object("bump", [a, b], 0.0));
    sim.scene_mut()
        .distance_objects_mut()
        .add(object("gap", [a, b], 0.0));
    run(
        &mut sim,
        "assert(sim.handleCollision(sim.handle_all) == 1 and sim.handleDistance(sim.handle_all) == 1)",
    );
    sim.scene_mut().modify_settings(|settings| {
        (
            settings.calculations.collision,
            settings.calculations.distance,
        ) = (false, false);
    });
    run(
        &mut sim,
        "assert(sim.handleCollision(sim.handle_all) == 0 and sim.handleDistance(sim.handle_all) == 0)",
    );
}

#[test]
fn the_largest_pictures_are_taken_and_larger_ones_are_not() {
    let mut sim = simulator();
    cube(&mut sim, 0.0);
    run(
        &mut sim,
        "for _, size in ipairs{2147483647, -1} do
            local sensor = sim.createVisionSensor(3, {size, size, 0, 0})
            local side = math.max(1, math.min(size, 4096))
            sim.setObjectPosition(sensor, {0, 0, -1})
            sim.handleVisionSensor(sensor)
            local image, resolution = sim.getVisionSensorImg(sensor)
            assert(resolution[1] == side and resolution[2] == side and #image == 3 * side * side)
            local depth = sim.getVisionSensorDepth(sensor, 1)
            local middle = 4 * (side // 2 * side + side // 2)
            local metres = string.unpack('<f', tostring(depth), middle + 1)
            assert(math.abs(metres - 0.9) < 1e-5, metres)
            sim.removeObjects({sensor})
        end",
    );
}

#[test]
fn sensors_at_no_place_see_nothing() {
    let mut sim = simulator();
    cube(&mut sim, 0.0);
    let nowhere = Pose::translation(f64::NAN, 0.0, f64::INFINITY);
    run(
        &mut sim,
        "eye, ray = sim.createVisionSensor(3, {8, 8, 0, 0}), sim.createProximitySensor(sim.proximitysensor_ray, 16, 1)
        sim.setObjectPosition(eye, {9, 0, 0})
        sim.setObjectPosition(ray, {9, 0, 0})
        for _, sensor in ipairs{eye, ray} do
            for _, odd in ipairs{0/0, 1/0, -1/0, 1e300} do
                pcall(sim.setObjectPosition, sensor, {odd, 0, odd})
                pcall(sim.setObjectOrientation, sensor, {odd, odd, 0})
                assert(sim.handleVisionSensor(eye) == 0 and sim.handleProximitySensor(ray) == 0)
            end
        end",
    );
    let sensors: Vec<Handle> = ["/visionSensor", "/proximitySensor"]
        .map(|path| {
            sim.call_api("sim.getObject", &[Data::text(path)]).unwrap()[0]
                .as_f64()
                .unwrap() as i64
        })
        .map(|raw| Handle::from_raw(raw).unwrap())
        .into();
    for sensor in sensors {
        // A pose that the scene itself would have to refuse.
        let _ = sim.scene_mut().set_world_pose(sensor, nowhere);
    }
    run(
        &mut sim,
        "assert(sim.handleVisionSensor(eye) == 0 and sim.handleProximitySensor(ray) == 0)
        assert(sim.checkVisionSensor(eye, sim.handle_all) == 0 and #sim.getVisionSensorImg(eye) == 192)",
    );
}

/// What 20 readings of a sensor with random rays report.
fn random_readings(seed: u32) -> Vec<Data> {
    let mut sim = Simulator::new(Options {
        seed,
        ..Options::default()
    });
    cube(&mut sim, 0.0);
    let script = run(
        &mut sim,
        "local ints, floats = {32, 32, 1, 16, 10, 3, 0, 0}, {0, 2, 0, 0, 0, 0, 0, 0, 0, 0.3, 0, 0, 0.01, 0, 0}
        sensor = sim.createProximitySensor(sim.proximitysensor_ray, 16, 1 | 512, ints, floats)
        sim.setObjectPosition(sensor, {0, 0, -1})
        function readings()
            local all = {}
            for i = 1, 20 do
                local result, distance, point = sim.handleProximitySensor(sensor)
                all[#all + 1] = result
                all[#all + 1] = distance
                for axis = 1, 3 do all[#all + 1] = point[axis] end
                assert(result == 0 or distance > 0.89 and distance < 2)
            end
            return all
        end",
    );
    sim.call(&script, "readings", &[])
        .expect("the sensor reads")
}

#[test]
fn random_rays_repeat_with_the_seed() {
    let first = random_readings(7);
    assert_eq!(first, random_readings(7));
    assert_ne!(first, random_readings(8));
    let Data::Array(numbers) = &first[0] else {
        panic!("{first:?}")
    };
    assert!(
        numbers
            .iter()
            .step_by(5)
            .filter(|result| result.as_f64() == Some(1.0))
            .count()
            > 10
    );
}
