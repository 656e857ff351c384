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
    <position joint="swing" kp="10" forcerange="-50 50"/>
    <position joint="lift" kp="10" forcerange="-100 100"/>
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
        "hook 1.00 0.00 2.00",
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
