//! Sensors and controllers for ROS 2: tags of URDF and SDF, parameters in YAML, settings in TOML.

use robot_description::ros::{self, Interface, Part, PartKind, Value};
use robot_description::{Parsed, urdf};

fn urdf_of(inside: &str) -> Parsed<Interface> {
    ros::of_urdf(format!("<robot name=\"r\">\n{inside}\n</robot>").as_bytes()).expect("XML")
}

fn only(parsed: &Parsed<Interface>) -> &Part {
    assert_eq!(lines(parsed), Vec::<String>::new());
    let [part] = parsed.value.parts.as_slice() else {
        panic!("one part: {:?}", parsed.value.parts);
    };
    part
}

fn lines<T>(parsed: &Parsed<T>) -> Vec<String> {
    parsed.warnings.iter().map(ToString::to_string).collect()
}

fn flag(part: &Part, key: &str) -> bool {
    part.values.get(key) == Some(&Value::Flag(true))
}

#[test]
fn a_lidar_has_its_rays_and_topics() {
    let parsed = urdf_of(
        r#"<gazebo reference="top"><sensor name="laser" type="gpu_lidar"><pose>1 2 3 0 0 0.5</pose><update_rate>10</update_rate>
        <topic>scan</topic><gz_frame_id>optics</gz_frame_id><lidar><scan><horizontal><samples>90</samples><resolution>1</resolution>
        <min_angle>-1.5</min_angle><max_angle>1.5</max_angle></horizontal><vertical><samples>4</samples><min_angle>-0.2</min_angle>
        <max_angle>0.2</max_angle></vertical></scan><range><min>0.1</min><max>30</max></range><noise><type>gaussian</type><mean>0</mean>
        <stddev>0.01</stddev></noise></lidar></sensor></gazebo>"#,
    );
    let part = only(&parsed);
    assert_eq!(
        (part.kind, part.name.as_str(), part.line),
        (PartKind::Lidar, "laser", 2)
    );
    let numbers = [
        "samples",
        "min_angle",
        "max_angle",
        "vertical_samples",
        "min_vertical_angle",
        "max_vertical_angle",
        "min_range",
        "max_range",
        "rate",
        "noise",
    ];
    let expected = [90.0, -1.5, 1.5, 4.0, -0.2, 0.2, 0.1, 30.0, 10.0, 0.01];
    for (key, number) in numbers.iter().zip(expected) {
        assert_eq!(part.number(key), Some(number), "{key}");
    }
    let texts = [
        ("link", "top"),
        ("topic", "scan"),
        ("points_topic", "scan/points"),
        ("frame", "optics"),
    ];
    for (key, text) in texts {
        assert_eq!(part.text(key), Some(text), "{key}");
    }
    assert_eq!(
        part.values["pose"],
        Value::Numbers(vec![1.0, 2.0, 3.0, 0.0, 0.0, 0.5])
    );
}

#[test]
fn topics_of_cameras_are_those_of_gazebo() {
    let topics = |sensor_type: &str, topic: &str| {
        let parsed = urdf_of(&format!(
            "<gazebo reference=\"l\"><sensor name=\"eye\" type=\"{sensor_type}\">{topic}<camera><horizontal_fov>1</horizontal_fov></camera></sensor></gazebo>"
        ));
        let part = only(&parsed).clone();
        let topic = |key: &str| part.text(key).unwrap_or("-").to_owned();
        ["topic", "info_topic", "depth_topic", "points_topic"].map(topic)
    };
    let said = "<topic>a/b</topic>";
    assert_eq!(
        topics("camera", ""),
        ["eye/image", "eye/camera_info", "-", "-"]
    );
    assert_eq!(topics("camera", said), ["a/b", "a/camera_info", "-", "-"]);
    assert_eq!(
        topics("depth_camera", said),
        ["a/b", "a/camera_info", "a/b", "a/b/points"]
    );
    assert_eq!(
        topics("rgbd_camera", said),
        [
            "a/b/image",
            "a/b/camera_info",
            "a/b/depth_image",
            "a/b/points"
        ]
    );
}

#[test]
fn plugins_of_gazebo_classic_say_topics_and_frames() {
    let parsed = urdf_of(
        r#"<gazebo reference="l"><sensor name="s" type="ray"><ray><range><min>0.1</min><max>5</max></range></ray>
        <plugin name="laser" filename="libgazebo_ros_ray_sensor.so"><ros><namespace>/demo</namespace><remapping>~/out:=scan</remapping></ros>
        <output_type>sensor_msgs/PointCloud2</output_type><frame_name>laser_frame</frame_name></plugin></sensor></gazebo>"#,
    );
    let part = only(&parsed);
    let texts = ["namespace", "topic", "points_topic", "frame"].map(|key| part.text(key));
    assert_eq!(
        texts,
        [
            Some("/demo"),
            Some("scan"),
            Some("scan"),
            Some("laser_frame")
        ]
    );
    let parsed = urdf_of(
        r#"<gazebo reference="l"><sensor name="s" type="depth"><plugin name="p" filename="libgazebo_ros_camera.so"><camera_name>front</camera_name></plugin></sensor></gazebo>"#,
    );
    let part = only(&parsed);
    let topics = [
        "topic",
        "info_topic",
        "depth_topic",
        "depth_info_topic",
        "points_topic",
    ]
    .map(|key| part.text(key).unwrap_or("-"));
    assert_eq!(
        topics,
        [
            "front/image_raw",
            "front/camera_info",
            "front/depth/image_raw",
            "front/depth/camera_info",
            "front/points"
        ]
    );
    assert!(flag(part, "color") && flag(part, "depth"));
}

#[test]
fn drives_of_both_gazebos_are_the_same() {
    let classic = r#"<gazebo><plugin name="d" filename="libgazebo_ros_diff_drive.so"><left_joint>a</left_joint><left_joint>b</left_joint><right_joint>c</right_joint>
        <wheel_separation>0.3</wheel_separation><wheel_diameter>0.2</wheel_diameter><ros><remapping>cmd_vel:=go</remapping><remapping>odom:=where</remapping></ros></plugin></gazebo>"#;
    let new = r#"<gazebo><plugin name="d" filename="gz-sim-diff-drive-system"><left_joint>a</left_joint><left_joint>b</left_joint><right_joint>c</right_joint>
        <wheel_separation>0.3</wheel_separation><wheel_radius>0.1</wheel_radius><topic>go</topic><odom_topic>where</odom_topic></plugin></gazebo>"#;
    let (classic, new) = (urdf_of(classic), urdf_of(new));
    let part = only(&classic);
    assert_eq!(part, only(&new));
    assert_eq!(part.texts("left_wheel_names"), ["a", "b"]);
    assert_eq!(
        (part.number("wheel_radius"), part.number("cmd_vel_timeout")),
        (Some(0.1), Some(0.5))
    );
    assert_eq!(
        (part.text("topic"), part.text("odom_topic")),
        (Some("go"), Some("where"))
    );
    let lacking = urdf_of(
        "<gazebo><plugin name=\"d\" filename=\"gz-sim-diff-drive-system\"><left_joint>a</left_joint></plugin></gazebo>",
    );
    assert_eq!(
        lines(&lacking),
        ["line 2, <diff_drive>: 'd': has no right_wheel_names; it is left out"]
    );
}

#[test]
fn joints_of_ros2_control_are_told_what_they_say() {
    let parsed = urdf_of(
        r#"<ros2_control name="h" type="system"><hardware><plugin>x</plugin></hardware><joint name="j">
        <command_interface name="position"><param name="min">-1</param><param name="max">2</param></command_interface><command_interface name="velocity"/>
        <state_interface name="position"><param name="initial_value">0.5</param></state_interface></joint><joint name="k"><state_interface name="position"/></joint></ros2_control>"#,
    );
    assert_eq!(lines(&parsed), Vec::<String>::new());
    let told: Vec<_> = parsed
        .value
        .commands
        .iter()
        .map(|one| {
            (
                one.joint.as_str(),
                one.interface.as_str(),
                one.range,
                one.initial,
            )
        })
        .collect();
    let none = [None, None];
    let expected = [
        ("j", "position", [Some(-1.0), Some(2.0)], Some(0.5)),
        ("j", "velocity", none, Some(0.5)),
        ("k", "", none, None),
    ];
    assert_eq!(told, expected);
    let mut interface = parsed.value;
    interface.add_usual_controllers();
    let usual: Vec<_> = interface
        .parts
        .iter()
        .map(|part| {
            (
                part.name.as_str(),
                part.text("topic").unwrap_or_default(),
                part.texts("joints").len(),
            )
        })
        .collect();
    let expected = [
        (
            "joint_trajectory_controller",
            "joint_trajectory_controller/joint_trajectory",
            1,
        ),
        (
            "forward_position_controller",
            "forward_position_controller/commands",
            1,
        ),
        (
            "forward_velocity_controller",
            "forward_velocity_controller/commands",
            1,
        ),
    ];
    assert_eq!(usual, expected);
}

#[test]
fn what_is_not_understood_has_its_line() {
    let parsed = urdf_of(
        "<gazebo><plugin filename=\"libmystery.so\"/></gazebo>\n<gazebo reference=\"l\"><sensor name=\"s\" type=\"sonar\"/>\n\
         <sensor name=\"c\" type=\"camera\"><camera><image><width>0</width></image>\n<lens><type>fish</type></lens></camera></sensor><magic/></gazebo>\n\
         <gazebo reference=\"l\"><mu1>1</mu1><sensor name=\"i\" type=\"imu\"><imu><angular_velocity><x><noise><bias_mean>0.1</bias_mean><mean>0</mean></noise></x></angular_velocity></imu></sensor></gazebo>",
    );
    let expected = [
        "line 2, <plugin>: the plugin 'libmystery.so' is not understood",
        "line 3, <sensor>: a sensor of type 'sonar' is not understood",
        "line 4, <width>: has '0', where a whole number from 1 to 4096 is needed",
        "line 5, <lens>: not understood inside of <camera>",
        "line 5, <magic>: not understood inside of <gazebo>",
        "line 6, <bias_mean>: has '0.1', which has no effect",
    ];
    assert_eq!(lines(&parsed), expected);
    assert_eq!(parsed.value.parts.len(), 2);
}

#[test]
fn sensors_and_plugins_of_sdf_are_read() {
    let text = r#"<sdf version="1.9"><world name="w"><model name="m"><link name="base"><sensor name="i" type="imu"><topic>imu</topic></sensor></link>
        <plugin filename="gz-sim-joint-state-publisher-system" name="p"><topic>joints</topic></plugin></model></world></sdf>"#;
    let parsed = ros::of_sdf(text.as_bytes()).expect("XML");
    let parts: Vec<_> = parsed
        .value
        .parts
        .iter()
        .map(|part| (part.kind, part.text("topic"), part.text("link")))
        .collect();
    assert_eq!(
        parts,
        [
            (PartKind::JointStates, Some("joints"), None),
            (PartKind::Imu, Some("imu"), Some("base"))
        ]
    );
}

const PARAMETERS: &str = "controller_manager:
  ros__parameters:
    update_rate: 100 # Hz
    drive: {type: diff_drive_controller/DiffDriveController}
    arm:
      type: joint_trajectory_controller/JointTrajectoryController
    odd:
      type: mystery/Mystery
/**/drive:
  ros__parameters:
    left_wheel_names: ['l 1',
      \"l2\"]
    right_wheel_names: [r]
    wheel_separation: 0.5
    wheel_radius: 1e-1
    linear.x.max_velocity: 2
    angular: {z: {max_velocity: 3.5}}
    publish_rate: fast
arm:
  ros__parameters:
    joints:
    - a
    - b
    command_interfaces: [velocity]
    constraints:
      a:
        goal: 0.1
    wings: 2
";

#[test]
fn controllers_are_those_of_the_manager_with_the_parameters_of_their_nodes() {
    let parsed = ros::of_yaml(PARAMETERS.as_bytes());
    let [drive, arm] = parsed.value.parts.as_slice() else {
        panic!("two controllers: {:?}", parsed.value.parts);
    };
    assert_eq!(drive.texts("left_wheel_names"), ["l 1", "l2"]);
    let numbers = [
        "wheel_separation",
        "wheel_radius",
        "linear.x.max_velocity",
        "angular.z.max_velocity",
    ];
    assert_eq!(
        numbers.map(|key| drive.number(key)),
        [Some(0.5), Some(0.1), Some(2.0), Some(3.5)]
    );
    assert_eq!(
        (drive.text("topic"), drive.text("odom_topic")),
        (Some("drive/cmd_vel"), Some("drive/odom"))
    );
    assert_eq!(
        (arm.texts("joints"), arm.text("interface_name")),
        (
            ["a".to_owned(), "b".to_owned()].as_slice(),
            Some("velocity")
        )
    );
    assert_eq!(arm.number("constraints.a.goal"), Some(0.1));
    let expected = [
        "line 7, <controller>: 'odd': the type 'mystery/Mystery' is not understood",
        "line 18, <publish_rate>: a number from 0 to 1000000 is needed",
        "line 28, <wings>: is no parameter of 'arm' that is understood",
    ];
    assert_eq!(lines(&parsed), expected);
}

#[test]
fn yaml_beyond_parameters_is_reported() {
    let parsed =
        ros::of_yaml(b"controller_manager:\n  ros__parameters:\n    a: &anchor 1\n    b: [1, [2\n");
    let expected = [
        "line 3, <YAML>: '&anchor 1' is not understood",
        "line 4, <YAML>: '[1, [2' is not understood",
    ];
    assert_eq!(lines(&parsed), expected);
    let nested = format!("a: {}{}", "[".repeat(10_000), "]".repeat(10_000));
    assert_eq!(ros::of_yaml(nested.as_bytes()).value.parts, []);
    let indented: String = (0..5000)
        .map(|level| format!("{}a:\n", " ".repeat(level)))
        .collect();
    assert!(
        lines(&ros::of_yaml(indented.as_bytes()))
            .iter()
            .any(|line| line.contains("too many levels"))
    );
}

#[test]
fn settings_in_toml_say_the_same() {
    let text = "namespace = \"r\"\nmodel = \"/Robot\"\n[[sensor]]\nname = \"s\"\ntype = \"lidar\"\nlink = \"l\"\nsamples = 10\n\
                [[controller]]\nname = \"c\"\ntype = \"velocity_controllers\"\njoints = [\"a\"]\nodd = 1\n[[joint]]\nname = \"a\"\ncommand = \"velocity\"\nmax = 2\n\
                [extra]\n[[sensor]]\ntype = \"imu\"\n";
    let parsed = ros::of_toml(text.as_bytes()).expect("TOML");
    let Interface {
        namespace,
        model,
        parts,
        commands,
        ..
    } = &parsed.value;
    assert_eq!(
        (namespace.as_deref(), model.as_deref()),
        (Some("r"), Some("/Robot"))
    );
    assert_eq!(
        (
            parts[0].kind,
            parts[0].number("samples"),
            parts[0].text("topic")
        ),
        (PartKind::Lidar, Some(10.0), Some("s/scan"))
    );
    assert_eq!(
        (
            parts[1].text("interface_name"),
            parts[1].text("topic"),
            parts[1].texts("joints").len()
        ),
        (Some("velocity"), Some("c/commands"), 1)
    );
    assert_eq!(
        (commands[0].joint.as_str(), commands[0].range),
        ("a", [None, Some(2.0)])
    );
    let found = lines(&parsed);
    assert_eq!(
        found[0],
        "line 12, <odd>: is no parameter of 'c' that is understood"
    );
    assert!(
        found[1].starts_with("line 17, <extra>: is not understood: there are namespace,"),
        "{found:?}"
    );
    assert_eq!(found[2], "line 18, <sensor>: needs a name and a type");
    let wrong = ros::of_toml(b"a = 1\nb = = 2\n").expect_err("no TOML");
    assert_eq!(wrong.line, 2);
}

#[test]
fn parts_of_joints_and_links_that_are_not_there_are_left_out() {
    let text = "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/></joint></robot>";
    let robot = urdf::read(text.as_bytes()).expect("URDF").value;
    let parsed = urdf_of(
        "<gazebo reference=\"a\"><sensor name=\"s\" type=\"imu\"/></gazebo><gazebo reference=\"z\"><sensor name=\"t\" type=\"imu\"/></gazebo>\n\
         <ros2_control name=\"h\"><joint name=\"j\"><command_interface name=\"effort\"/></joint><joint name=\"k\"><command_interface name=\"effort\"/></joint></ros2_control>",
    );
    let fitting = parsed.value.fitting(&robot);
    assert_eq!(
        (fitting.value.parts.len(), fitting.value.commands.len()),
        (1, 1)
    );
    assert_eq!(
        lines(&fitting),
        [
            "line 2, <imu>: 't': there is no link 'z'; it is left out",
            "line 3, <joint>: there is no joint 'k'"
        ]
    );
}

#[test]
fn parts_that_cannot_be_are_left_out() {
    let lidar = |inside: &str| {
        let text = format!("[[sensor]]\nname = \"s\"\ntype = \"lidar\"\n{inside}");
        lines(&ros::of_toml(text.as_bytes()).expect("TOML")).join("; ")
    };
    assert_eq!(lidar(""), "");
    assert!(lidar("min_angle = 1\nmax_angle = 0").contains("min_angle is above max_angle"));
    assert!(lidar("min_range = 2\nmax_range = 1").contains("max_range is not above min_range"));
    assert!(lidar("max_vertical_angle = 1.5").contains("beyond 1.4 radians"));
    assert!(lidar("samples = 60000\nvertical_samples = 4000").contains("too many rays"));
    assert!(lidar("max_range = nan").contains("a number from"));
    assert!(lidar("samples = 1.5").contains("a whole number"));
}
