//! Robots in MJCF and SDF: run, and converted.

use std::fs;
use std::path::Path;

use test_support::process::output_of;

use super::swanilda;

const CRANE: &str = r#"<mujoco model="crane">
  <compiler angle="radian"/>
  <worldbody>
    <geom type="plane" size="1 1 .1"/>
    <body name="post" pos="0 0 1">
      <geom type="box" size=".1 .1 1"/>
      <body name="boom" pos="0 0 1">
        <joint name="swing" range="-3 3" ref=".2"/>
        <joint name="lift" axis="0 1 0" range="-1 1"/>
        <geom type="capsule" fromto="0 0 0 1 0 0" size=".05" mass="4" contype="0" conaffinity="0"/>
        <site name="hook" pos="1 0 0"/>
      </body>
    </body>
    <body name="load" pos="2 0 .1"><freejoint/><geom type="ellipsoid" size=".1 .1 .1" mass="3"/></body>
  </worldbody>
  <actuator>
    <position joint="swing" kp="1e5" kv="1e3" forcerange="-50 50"/>
    <position joint="lift" kp="1e5" kv="1e3" forcerange="-100 100"/>
  </actuator>
  <equality><odd/></equality>
</mujoco>"#;

/// Prints what a model became, and what it does in two seconds.
const LOOK: &str = "sim = require 'sim'
function sysCall_init()
    sim.loadModel(sim.getNamedStringParam('model'))
    lift, hook = sim.getObject('/lift'), sim.getObject('/hook')
    for _, name in ipairs {'/post_respondable', '/boom_respondable', '/load_respondable'} do
        local shape = sim.getObject(name)
        print(name, string.format('%.3f', sim.getShapeMass(shape)), sim.getObjectInt32Param(shape, sim.shapeintparam_static))
    end
    print(string.format('swing %.3f', sim.getJointPosition(sim.getObject('/swing'))), sim.getJointTargetForce(lift))
end
function sysCall_sensing()
    at = sim.getObjectPosition(hook)
end
function sysCall_afterSimulation()
    print(string.format('hook %.2f %.2f %.2f', at[1], math.abs(at[2]), at[3]))
end";

fn said_by(folder: &Path, args: &[&str]) -> String {
    let output = output_of(swanilda().args(args).current_dir(folder));
    let all = [output.stdout, output.stderr].concat();
    let text = String::from_utf8_lossy(&all).into_owned();
    assert!(output.status.success(), "{args:?}: {text}");
    text
}

#[test]
fn a_robot_in_mjcf_is_run_and_converted() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let folder = folder.path();
    fs::write(folder.join("crane.xml"), CRANE).expect("our own folder is writable");
    fs::write(folder.join("look.lua"), LOOK).expect("our own folder is writable");
    let said = said_by(folder, &["run", "crane.xml", "--steps", "2"]);
    assert!(said.contains("line 20, <odd>: <odd> is not read"), "{said}");
    said_by(folder, &["convert", "crane.xml", "crane.ttm"]);
    let said = said_by(
        folder,
        &[
            "run",
            "look.lua",
            "--time",
            "2",
            "-q",
            "-D",
            "model=crane.ttm",
        ],
    );
    let expected = [
        "/post_respondable, 80.000, 1",
        "/boom_respondable, 4.000, 0",
        "/load_respondable, 3.000, 0",
        "swing 0.200, 100",
        "hook 0.98 0.20 2.00",
    ];
    let found = expected.iter().all(|line| said.contains(line));
    assert!(found, "{said}");
    said_by(folder, &["convert", "crane.ttm", "crane.urdf"]);
    let text = fs::read_to_string(folder.join("crane.urdf")).expect("it was written");
    assert!(
        text.contains("<joint name=\"lift\" type=\"revolute\">"),
        "{text}"
    );
}

/// A slider without limits on a spring, with a rotor and a motor that pushes with nothing; a cart that falls on the ground of its file, on which it hangs.
const SLIDERS: &str = r#"<mujoco model="sliders">
  <worldbody>
    <geom type="plane" size="5 5 .1"/>
    <body name="mass" pos="0 0 2"><joint name="slide" type="slide" axis="1 0 0" ref=".8" stiffness="50" armature="2"/><geom type="box" size=".1 .1 .1" mass="3"/></body>
    <body name="cart" pos="0 2 1">
      <joint name="along" type="slide" axis="1 0 0"/><joint name="down" type="slide" axis="0 0 1"/><geom type="box" size=".1 .1 .1" mass="3"/>
    </body>
  </worldbody>
  <actuator><motor joint="slide" gear="3" ctrlrange="-1 1"/></actuator>
</mujoco>"#;

const LOOKS_AT_SLIDERS: &str = "sim = require 'sim'
function sysCall_init()
    sim.loadModel(sim.getNamedStringParam('model'))
    slide = sim.getObject('/slide')
end
function sysCall_sensing()
    at = {sim.getJointPosition(slide), sim.getJointPosition(sim.getObject('/down')), sim.getJointForce(slide) or 0}
    if sim.getSimulationTime() > 0.89 then sim.setJointTargetForce(slide, -7) end
end
function sysCall_afterSimulation()
    print(string.format('slide %.2f down %.2f force %.2f', table.unpack(at)))
end";

#[test]
fn springs_and_rotors_of_mjcf_outlast_a_model_file() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let folder = folder.path();
    fs::write(folder.join("sliders.xml"), SLIDERS).expect("our own folder is writable");
    fs::write(folder.join("look.lua"), LOOKS_AT_SLIDERS).expect("our own folder is writable");
    said_by(folder, &["convert", "sliders.xml", "sliders.ttm"]);
    for model in ["model=sliders.xml", "model=sliders.ttm"] {
        let run = [
            "run", "look.lua", "--empty", "--time", "1", "-q", "-D", model,
        ];
        let said = said_by(folder, &run);
        // A swing of sqrt(50 / (3 + 2)) rad/s is at 0.8 cos(3.64) = -0.70 after the 1.15 s of this run; the motor pushes with as much as it can in the last
        // fifth of a second, which adds 3 / 50 (1 - cos(0.63)) = 0.01.
        assert!(
            said.contains("slide -0.71 down -0.90 force 3.00"),
            "{model}: {said}"
        );
    }
}

/// A box that carries a long arm, which it cannot hold upright.
const POLE: &str = r#"<robot name="pole">
  <link name="base"><inertial><mass value="0.1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="0.05 0.05 0.05"/></geometry></collision></link>
  <link name="arm"><inertial><origin xyz="0.2 0 0.5"/><mass value="2"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="j" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="100" velocity="1"/></joint>
</robot>"#;

/// A chain that a motor rolls up: its last link meets the first one, its neighbour does not. A foot without mass is fixed to the last link.
const ROLLS_UP: &str = r#"<mujoco model="rolls">
  <option><flag gravity="disable"/></option>
  <worldbody>
    <body name="first" pos="0 0 1">
      <joint name="hold" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 1 0 0" size=".06" mass="50"/>
      <body name="second" pos="1 0 0">
        <joint name="bend" axis="0 1 0" damping="2"/><geom type="capsule" fromto="0 0 0 .3 0 0" size=".06" mass="1"/>
        <body name="third" pos=".3 0 0">
          <joint name="curl" axis="0 1 0" damping="2"/><geom type="capsule" fromto="0 0 0 1 0 0" size=".06" mass="1"/>
          <body name="foot" pos="1 0 0"><geom size=".02" mass="0"/></body>
        </body>
      </body>
    </body>
  </worldbody>
  <contact><!-- more --></contact>
  <actuator><position joint="bend" kp="100" kv="10"/><position joint="curl" kp="100" kv="10"/><velocity joint="curl" kv="20"/></actuator>
</mujoco>"#;

const LOOKS_AT_CHAIN: &str = "sim = require 'sim'
function sysCall_init()
    sim.setArrayParam(sim.arrayparam_gravity, {0, 0, 0})
    sim.loadModel(sim.getNamedStringParam('model'))
    bend, curl = sim.getObject('/bend'), sim.getObject('/curl')
    sim.setJointTargetPosition(bend, 1.6)
    sim.setJointTargetPosition(curl, 2.4)
    local foot = sim.getObject('/foot_respondable')
    print(string.format('foot of %.0f g', 1000 * sim.getShapeMass(foot)))
end
function sysCall_sensing() at = sim.getJointPosition(curl) end
function sysCall_afterSimulation()
    print(string.format('curl %.2f', at))
end";

/// The last link lies on the first one, unless the file says that they do not touch.
#[test]
fn links_of_mjcf_touch_as_the_file_says() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let folder = folder.path();
    fs::write(folder.join("look.lua"), LOOKS_AT_CHAIN).expect("our own folder is writable");
    let exclude = r#"<exclude body1="first" body2="third"/><exclude body1="foot" body2="first"/>"#;
    let free = ROLLS_UP.replace("<!-- more -->", exclude);
    let model = ["touches.xml", "passes.xml"];
    fs::write(folder.join(model[0]), ROLLS_UP).expect("our own folder is writable");
    fs::write(folder.join(model[1]), free).expect("our own folder is writable");
    let curls = model.map(|model| {
        let model = format!("model={model}");
        let run = [
            "run", "look.lua", "--empty", "--time", "3", "-q", "-D", &model,
        ];
        let said = said_by(folder, &run);
        assert!(said.contains("foot of 1 g"), "{said}");
        let angle = said
            .split("curl ")
            .nth(1)
            .and_then(|rest| rest.lines().next());
        angle
            .and_then(|angle| angle.parse::<f64>().ok())
            .unwrap_or_else(|| panic!("{said}"))
    });
    // The springs leave it at its target where nothing is in the way.
    assert!(curls[0] < 2.1 && (curls[1] - 2.4).abs() < 0.01, "{curls:?}");
}

/// A ball that sinks: of the box with its moments of inertia every edge is sqrt(12 / 5) of its radius.
#[test]
fn bodies_of_mjcf_sink_in_their_fluid() {
    const BALL: &str = r#"<mujoco><option viscosity="10"/><worldbody><body name="ball"><freejoint/><geom size=".1" mass="1"/></body></worldbody></mujoco>"#;
    const LOOK: &str = "sim = require 'sim'
function sysCall_init()
    sim.loadModel(sim.getNamedStringParam('model'))
    ball = sim.getObject('/ball_respondable')
end
function sysCall_sensing() down = -sim.getObjectVelocity(ball)[3] end
function sysCall_afterSimulation() print(string.format('down at %.4f', down)) end";
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let folder = folder.path();
    fs::write(folder.join("ball.xml"), BALL).expect("our own folder is writable");
    fs::write(folder.join("look.lua"), LOOK).expect("our own folder is writable");
    said_by(folder, &["convert", "ball.xml", "ball.ttm"]);
    let speed = 9.81 / (3.0 * std::f64::consts::PI * 10.0 * 0.1 * (12.0_f64 / 5.0).sqrt());
    for model in ["model=ball.xml", "model=ball.ttm"] {
        let run = [
            "run", "look.lua", "--empty", "--time", "2", "-q", "-D", model,
        ];
        let said = said_by(folder, &run);
        let expected = format!("down at {speed:.4}");
        assert!(
            said.contains(&expected),
            "{model}: {said} instead of {expected}"
        );
    }
}

/// A box that adheres to the ceiling until it is told not to, a ball of whose weight half is compensated, and a box that a belt carries; with Bullet as the engine, and from a model file too.
#[test]
fn bodies_of_mjcf_adhere_float_and_are_carried() {
    const BODIES: &str = r#"<mujoco><worldbody>
        <body name="ceiling" pos="0 0 2"><geom type="box" size="1 1 .1"/></body>
        <body name="hung" pos="0 0 1.8"><freejoint/><geom type="box" size=".1 .1 .1" mass="1"/></body>
        <body name="ball" pos="0 5 9" gravcomp=".5"><freejoint/><geom size=".1" mass="1"/></body>
        <body name="belt" pos="0 10 0" euler="0 0 90"><geom type="box" size="3 1 .1" surfacevel=".5 0 0 0 0 0"/></body>
        <body name="parcel" pos="0 10 .2"><freejoint/><geom type="box" size=".1 .1 .1" mass="1"/></body>
        </worldbody><actuator><adhesion body="hung" gain="10" ctrlrange="0 3"/></actuator></mujoco>"#;
    const LOOK: &str = "sim = require 'sim'
local function body(name) return sim.getObject('/' .. name .. '_respondable') end
function sysCall_init()
    sim.loadModel(sim.getNamedStringParam('model'))
    sim.setFloatProperty(body('hung'), 'mujoco.adhesionctrl', 2)
end
function sysCall_sensing()
    hangs = sim.getObjectPosition(body('hung'))[3]
    down = -sim.getObjectVelocity(body('ball'))[3]
    along = sim.getObjectVelocity(body('parcel'))[2]
end
function sysCall_afterSimulation() print(string.format('%.3f %.3f %.3f', hangs, down, along)) end";
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let folder = folder.path();
    fs::write(folder.join("bodies.xml"), BODIES).expect("our own folder is writable");
    fs::write(folder.join("look.lua"), LOOK).expect("our own folder is writable");
    said_by(folder, &["convert", "bodies.xml", "bodies.ttm"]);
    for model in ["model=bodies.xml", "model=bodies.ttm"] {
        let run = [
            "run", "look.lua", "--empty", "--steps", "20", "-q", "-D", model,
        ];
        let said = said_by(folder, &run);
        let numbers = said.split_whitespace().map(str::parse::<f64>);
        let numbers: Vec<f64> = numbers.collect::<Result<_, _>>().unwrap_or_default();
        let [hangs, down, along] = numbers[..] else {
            panic!("{model}: {said}");
        };
        // All are lifted so that they are on the ground, by what the lowest is under it.
        let seconds = down / 4.905;
        assert!((0.9..1.2).contains(&seconds), "{model}: {said}");
        assert!((along - 0.5).abs() < 1e-3, "{model}: {said}");
        assert!((hangs - 1.8).abs() < 0.2, "{model}: {said}");
    }
}

#[test]
fn a_free_base_that_falls_over_is_told_and_can_be_fixed() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let folder = folder.path();
    fs::write(folder.join("pole.urdf"), POLE).expect("our own folder is writable");
    let said = said_by(folder, &["run", "pole.urdf", "--time", "2"]);
    assert!(
        said.contains("/base_respondable has fallen over") && said.contains("--fix-base"),
        "{said}"
    );
    let said = said_by(folder, &["run", "pole.urdf", "--time", "2", "--fix-base"]);
    assert!(!said.contains("fallen"), "{said}");
    fs::write(folder.join("look.lua"), LOOKS_AT_BASE).expect("our own folder is writable");
    for (option, is_static) in [(None, "0"), (Some("--fix-base"), "1")] {
        let convert = ["convert", "pole.urdf", "pole.ttm"];
        let args: Vec<&str> = convert.into_iter().chain(option).collect();
        said_by(folder, &args);
        let said = said_by(folder, &["run", "look.lua", "--no-start", "-q"]);
        assert!(said.contains(&format!("pole.ttm, {is_static}")), "{said}");
    }
}

/// Loads models in two formats, and prints whether their bases are static.
const LOOKS_AT_BASE: &str = "sim = require 'sim'
function sysCall_init()
    for _, name in ipairs {'pole.ttm', 'pole.urdf'} do
        print(name, sim.getObjectInt32Param(sim.loadModel(name), sim.shapeintparam_static))
    end
end";

#[test]
fn scripts_load_robots_as_models() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let folder = folder.path();
    let write = |name: &str, text: &str| {
        fs::write(folder.join(name), text).expect("our own folder is writable");
    };
    write("pole.urdf", POLE);
    write("crane.xml", CRANE);
    write(
        "ball.sdf",
        "<sdf><model name='ball'><link name='l'><visual name='v'><geometry><sphere><radius>1</radius></sphere></geometry></visual></link></model></sdf>",
    );
    write(
        "load.lua",
        "sim = require 'sim'
for _, name in ipairs {'pole.urdf', 'ball.sdf', 'crane.xml'} do print(sim.getObjectAlias(sim.loadModel(name), 1)) end",
    );
    let args = ["run", "load.lua", "--as", "sandbox", "--no-start"];
    let said = said_by(folder, &args);
    for name in ["/base_respondable", "/l_respondable", "/crane"] {
        assert!(said.contains(name), "{name}: {said}");
    }
    assert!(said.contains("crane.xml: line 20, <odd>"), "{said}");
}

#[test]
fn only_robots_have_bases_to_fix() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    fs::write(folder.path().join("scene.lua"), "").expect("our own folder is writable");
    let args = ["run", "scene.lua", "--fix-base"];
    let output = output_of(swanilda().args(args).current_dir(folder.path()));
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        said.contains("only the bases of robots in URDF, SDF and MJCF"),
        "{said}"
    );
}

/// An arm under a string over two places, and a finger whose joints are coupled by a spring and moved by one servo.
const TENDONS: &str = r#"<mujoco model="tendons">
  <worldbody>
    <body name="base" pos="0 0 2">
      <geom type="box" size=".05 .05 .05" contype="0" conaffinity="0"/><site name="top" pos="0.3 0 0.3"/>
      <body>
        <joint name="shoulder" axis="0 1 0" damping="0.02"/><site name="elbow" pos="0.3 0 0"/>
        <geom type="capsule" fromto="0 0 0 0.3 0 0" size=".02" mass="0.5" contype="0" conaffinity="0"/>
        <body pos="0.3 0 0">
          <joint name="bend" axis="0 1 0" damping="0.02"/><site name="tip" pos="0.3 0 0"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size=".02" mass="0.3" contype="0" conaffinity="0"/>
        </body>
      </body>
      <body pos="0 0.3 0">
        <joint name="f1" axis="0 1 0" damping="0.01" armature="0.0005"/>
        <geom type="capsule" fromto="0 0 0 0.05 0 0" size=".01" mass="0.02" contype="0" conaffinity="0"/>
        <body pos="0.05 0 0">
          <joint name="f2" axis="0 1 0" damping="0.01" armature="0.0005"/>
          <geom type="capsule" fromto="0 0 0 0.05 0 0" size=".01" mass="0.02" contype="0" conaffinity="0"/>
        </body>
      </body>
    </body>
  </worldbody>
  <tendon>
    <spatial name="string" stiffness="60" damping="1" springlength="0.35"><site site="top"/><site site="elbow"/><site site="tip"/></spatial>
    <fixed name="curl"><joint joint="f1" coef="1"/><joint joint="f2" coef="1"/></fixed>
    <fixed name="couple" stiffness="2" damping="0.02"><joint joint="f1" coef="1"/><joint joint="f2" coef="-1"/></fixed>
  </tendon>
  <actuator><position name="curl" tendon="curl" kp="3" kv="0.05"/></actuator>
</mujoco>"#;

/// Compares the joints with what MuJoCo 4.0 computes at 0.1 ms.
const LOOKS_AT_TENDONS: &str = "sim = require 'sim'
local expected = {
    [0.25] = {-0.74934, 2.46128, -0.49686, -0.50009}, [0.5] = {-0.55582, 2.956, -0.49686, -0.5001},
    [1] = {-0.49127, 1.79682, -0.49686, -0.5001}, [2] = {-0.49827, 2.05582, -0.49686, -0.5001},
}
local worst = 0
function sysCall_init()
    sim.loadModel(sim.getNamedStringParam('model'))
    local function joint(name) return sim.getObject('/' .. name) end
    joints = {joint 'shoulder', joint 'bend', joint 'f1', joint 'f2'}
    sim.setFloatProperty(sim.getObject('/curl'), 'customData.targetPosition', -1)
end
function sysCall_sensing()
    local now = sim.getSimulationTime() + sim.getSimulationTimeStep()
    for time, places in pairs(expected) do
        for i, place in ipairs(places) do
            if math.abs(now - time) < 1e-6 then worst = math.max(worst, math.abs(sim.getJointPosition(joints[i]) - place)) end
        end
    end
end
function sysCall_afterSimulation() print(worst < 0.01 and worst > 0 and 'as MuJoCo' or 'off by ' .. worst) end";

/// Tendons move as MuJoCo's do, from the file and from a model that was made of it.
#[test]
fn tendons_of_mjcf_move_as_mujocos_do_and_outlast_a_model_file() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let folder = folder.path();
    fs::write(folder.join("tendons.xml"), TENDONS).expect("our own folder is writable");
    fs::write(folder.join("look.lua"), LOOKS_AT_TENDONS).expect("our own folder is writable");
    said_by(folder, &["convert", "tendons.xml", "tendons.ttm"]);
    for model in ["model=tendons.xml", "model=tendons.ttm"] {
        let run = [
            "run", "look.lua", "--empty", "--time", "2.1", "-q", "-D", model,
        ];
        let said = said_by(folder, &run);
        assert!(said.contains("as MuJoCo"), "{model}: {said}");
    }
}
