//! Files that were damaged at random places: an error, or a robot whose links have frames. The fuzz targets do the same for longer.

use robot_description::mjcf::{self, Files, Triangles};
use robot_description::sdf::{self, Included};
use robot_description::{Robot, ros, urdf};
use test_support::random::Random;

const ROUNDS: usize = 4000;

const URDF: &str = r#"<?xml version="1.0"?><robot name="r"><material name="m"><color rgba="1 0 0 1"/></material>
<link name="a"><inertial><origin xyz="0 0 1" rpy="1 2 3"/><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<visual><geometry><mesh filename="package://p/m.dae" scale="1 1 1"/></geometry><material name="m"/></visual><collision><geometry><box size="1 2 3"/></geometry></collision></link>
<link name="b"/><link name="c"><collision><geometry><sphere radius="1"/></geometry></collision></link>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/><origin xyz="1 0 0"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="2" velocity="3"/></joint>
<joint name="k" type="prismatic"><parent link="b"/><child link="c"/><mimic joint="j" multiplier="2" offset="1"/><dynamics damping="1"/></joint></robot>"#;

const SDF: &str = r#"<sdf version="1.9"><world name="w"><gravity>0 0 -1</gravity><frame name="f"><pose>1 0 0 0 0 0</pose></frame><include><uri>x</uri></include>
<model name="m"><pose relative_to="f">0 1 0 0 0 1</pose><link name="a"><pose relative_to="j">0 0 1 0 0 0</pose><inertial><mass>1</mass></inertial></link><link name="b"/>
<model name="n"><link name="c"/></model><joint name="j" type="universal"><parent>b</parent><child>n::c</child><axis><xyz expressed_in="__model__">0 1 0</xyz></axis><axis2/></joint>
<joint name="k" type="revolute"><parent>world</parent><child>b</child><axis><xyz>1 0 0</xyz><limit><lower>-1</lower></limit></axis></joint></model></world></sdf>"#;

const MJCF: &str = r#"<mujoco model="m"><compiler angle="radian" eulerseq="XYZ" settotalmass="3" boundinertia="1"/><include file="x"/><default><default class="c"><geom size=".1 .2"/></default></default>
<asset><mesh name="h" file="h.stl"/></asset><worldbody><geom type="plane"/><body name="a" euler="1 2 3" childclass="c"><freejoint/><geom type="capsule"/>
<frame pos="1 0 0"><body name="b" xyaxes="1 0 0 0 1 0"><joint name="j" ref="1" range="0 1"/><joint name="k" type="slide"/><joint type="ball"/><geom type="mesh" mesh="h"/><site name="s"/></body></frame>
<inertial mass="1" pos="0 0 0" fullinertia="1 2 3 0 0 0"/></body></worldbody><actuator><position joint="j"/><general joint="k" biastype="affine" biasprm="0 -1 -2"/></actuator>
<equality><joint joint1="j" joint2="k"/><connect body1="a" anchor="1 2 3"/><weld site1="s" site2="s"/></equality></mujoco>"#;

/// The text with pieces of it missing, twice, elsewhere, or replaced by what is odd.
fn damaged(random: &mut Random, text: &str) -> Vec<u8> {
    const ODD: [&str; 12] = [
        "",
        "\"",
        "<",
        ">",
        "nan",
        "1e999",
        "-1e99",
        "0",
        "\u{0}",
        "/>",
        " 1 1 1 1 1 1 1",
        "world",
    ];
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..=random.below(4) {
        let from = random.below(bytes.len());
        let to = (from + random.below(40)).min(bytes.len());
        let piece: Vec<u8> = bytes[from..to].to_vec();
        let at = random.below(bytes.len());
        match random.below(4) {
            0 => drop(bytes.drain(from..to)),
            1 => drop(bytes.splice(at..at, piece)),
            2 => drop(bytes.splice(from..to, ODD[at % ODD.len()].bytes())),
            _ => bytes.truncate(from.max(10)),
        }
        bytes.push(b' ');
    }
    bytes
}

fn check(robot: &Robot) {
    let poses = robot
        .link_poses(&robot.zero_positions())
        .expect("as many positions as the joints have");
    assert_eq!(poses.len(), robot.links.len());
}

#[test]
fn urdf() {
    let mut random = Random::new(1);
    for _ in 0..ROUNDS {
        if let Ok(parsed) = urdf::read(&damaged(&mut random, URDF)) {
            check(&parsed.value);
            let again =
                urdf::read(urdf::write(&parsed.value).as_bytes()).expect("what is written is read");
            assert_eq!(again.value.links.len(), parsed.value.links.len());
        }
    }
}

const ROS: &str = r#"<robot name="r"><ros2_control name="h"><joint name="j"><command_interface name="position"><param name="min">-1</param></command_interface>
<state_interface name="position"><param name="initial_value">1</param></state_interface></joint></ros2_control><gazebo><plugin filename="gz-sim-diff-drive-system"><left_joint>a</left_joint>
<right_joint>b</right_joint><wheel_separation>1</wheel_separation><wheel_radius>1</wheel_radius></plugin><plugin filename="gz_ros2_control"><parameters>x.yaml</parameters></plugin></gazebo>
<gazebo reference="l"><sensor name="s" type="rgbd_camera"><pose>0 0 0 1 2 3</pose><camera><image><width>10</width></image></camera></sensor>
<sensor name="t" type="ray"><ray><range><min>1</min><max>2</max></range></ray></sensor></gazebo></robot>"#;

const YAML: &str = "controller_manager:\n  ros__parameters:\n    a: {type: diff_drive_controller}\n    b:\n      type: \"joint_trajectory_controller/JointTrajectoryController\"\na:\n  ros__parameters:\n    left_wheel_names: [x, 'y',\n      z]\n    linear: {x: {max_velocity: 1.5}}\nb:\n  ros__parameters:\n    joints:\n    - é\n    - k # one\n";

const TOML: &str = "namespace = \"r\"\n[[sensor]]\nname = \"s\"\ntype = \"lidar\"\npose = [0, 0, 1, 0, 0, 0.5]\n[[controller]]\nname = \"c\"\ntype = \"forward_command_controller\"\njoints = ['j']\nlinear.x = {y = 2}\n[[joint]]\nname = \"j\"\n";

#[test]
fn ros_interfaces() {
    let mut random = Random::new(4);
    let robot = urdf::read(URDF.as_bytes()).expect("URDF").value;
    for _ in 0..ROUNDS {
        let tags = [
            ros::of_urdf(&damaged(&mut random, ROS)).ok(),
            ros::of_sdf(&damaged(&mut random, ROS)).ok(),
            Some(ros::of_yaml(&damaged(&mut random, YAML))),
            ros::of_toml(&damaged(&mut random, TOML)).ok(),
        ];
        for parsed in tags.into_iter().flatten() {
            let mut interface = parsed.value.fitting(&robot).value;
            interface.add_usual_controllers();
            let numbers = interface.parts.iter().flat_map(|part| part.values.values());
            assert!(
                numbers.clone().all(
                    |value| !matches!(value, ros::Value::Number(number) if !number.is_finite())
                )
            );
        }
    }
}

#[test]
fn sdf() {
    let mut random = Random::new(2);
    for _ in 0..ROUNDS {
        let included = damaged(&mut random, SDF);
        let mut include = |_: &str| {
            Ok(Included {
                bytes: included.clone(),
                folder: String::new(),
            })
        };
        if let Ok(parsed) = sdf::read(&damaged(&mut random, SDF), &mut include) {
            parsed
                .value
                .models
                .iter()
                .for_each(|model| check(&model.robot));
        }
    }
}

struct Damaged(Vec<u8>, bool);

impl Files for Damaged {
    fn include(&mut self, _: &str) -> Result<Vec<u8>, String> {
        Ok(self.0.clone())
    }

    fn triangles(&mut self, _: &str) -> Result<Triangles, String> {
        let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let corners = if self.1 {
            vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
        } else {
            vec![[0, 0, 9]]
        };
        Ok(Triangles { vertices, corners })
    }
}

#[test]
fn mjcf() {
    let mut random = Random::new(3);
    for round in 0..ROUNDS {
        let mut files = Damaged(damaged(&mut random, MJCF), round % 2 == 0);
        if let Ok(parsed) = mjcf::read(&damaged(&mut random, MJCF), &mut files) {
            check(&parsed.value.robot);
        }
    }
}
