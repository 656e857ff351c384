//! The schemas of Foxglove that are written, as descriptors of protocol buffers (foxglove.dev, "Message schemas"; descriptor.proto).

use super::proto::Proto;

const TIMESTAMP: &str = "google.protobuf.Timestamp";

/// Messages of the package `foxglove`, with their fields as in a .proto file.
const MESSAGES: &[(&str, &str)] = &[
    ("Vector3", "double x=1; double y=2; double z=3"),
    ("Point3", "double x=1; double y=2; double z=3"),
    (
        "Quaternion",
        "double x=1; double y=2; double z=3; double w=4",
    ),
    ("Color", "double r=1; double g=2; double b=3; double a=4"),
    ("Pose", "Vector3 position=1; Quaternion orientation=2"),
    (
        "FrameTransform",
        "google.protobuf.Timestamp timestamp=1; string parent_frame_id=2; string child_frame_id=3; \
         Vector3 translation=4; Quaternion rotation=5",
    ),
    ("FrameTransforms", "repeated FrameTransform transforms=1"),
    (
        "TriangleListPrimitive",
        "Pose pose=1; repeated Point3 points=2; Color color=3; repeated Color colors=4; repeated fixed32 indices=5",
    ),
    (
        "SceneEntityDeletion",
        "google.protobuf.Timestamp timestamp=1; SceneEntityDeletion.Type type=2; string id=3",
    ),
    (
        "SceneEntity",
        "google.protobuf.Timestamp timestamp=1; string frame_id=2; string id=3; \
         google.protobuf.Duration lifetime=4; bool frame_locked=5; repeated TriangleListPrimitive triangles=12",
    ),
    (
        "SceneUpdate",
        "repeated SceneEntityDeletion deletions=1; repeated SceneEntity entities=2",
    ),
    ("JointState", "string name=1; optional double position=2"),
    (
        "JointStates",
        "google.protobuf.Timestamp timestamp=1; repeated JointState joints=2",
    ),
    (
        "RawImage",
        "google.protobuf.Timestamp timestamp=1; fixed32 width=2; fixed32 height=3; string encoding=4; \
         fixed32 step=5; bytes data=6; string frame_id=7",
    ),
    (
        "Log",
        "google.protobuf.Timestamp timestamp=1; Log.Level level=2; string message=3; string name=4; string file=5; \
         fixed32 line=6",
    ),
];

/// Enumerations, by the message that contains them; numbers count from zero.
const ENUMERATIONS: &[(&str, &str, &[&str])] = &[
    (
        "Log",
        "Level",
        &["UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"],
    ),
    ("SceneEntityDeletion", "Type", &["MATCHING_ID", "ALL"]),
];

/// The descriptors that a reader needs for any of the messages: a `FileDescriptorSet`.
pub(super) fn descriptors() -> Vec<u8> {
    let time = "int64 seconds=1; int32 nanos=2";
    let of_google = |file: &str, name: &str| {
        let message = message("google.protobuf", name, time);
        Proto::new()
            .text(1, file)
            .text(2, "google.protobuf")
            .message(4, message)
            .text(12, "proto3")
    };
    let files = [
        "google/protobuf/timestamp.proto",
        "google/protobuf/duration.proto",
    ];
    let own = Proto::new()
        .text(1, "foxglove.proto")
        .text(2, "foxglove")
        .text(3, files[0])
        .text(3, files[1]);
    let own = own.messages(
        4,
        MESSAGES
            .iter()
            .map(|(name, fields)| message("foxglove", name, fields)),
    );
    let all = [
        of_google(files[0], "Timestamp"),
        of_google(files[1], "Duration"),
        own.text(12, "proto3"),
    ];
    Proto::new().messages(1, all).into_bytes()
}

/// A `DescriptorProto`.
fn message(package: &str, name: &str, fields: &str) -> Proto {
    let fields: Vec<&str> = fields.split(';').map(str::trim).collect();
    let described = Proto::new()
        .text(1, name)
        .messages(2, fields.iter().map(|line| field(package, line)));
    let own = ENUMERATIONS
        .iter()
        .filter(|(of, ..)| *of == name && package == "foxglove");
    described.messages(4, own.map(|(_, name, words)| enumeration(name, words)))
}

fn enumeration(name: &str, words: &[&str]) -> Proto {
    let values = (0..)
        .zip(words)
        .map(|(number, word)| Proto::new().text(1, word).int(2, number));
    Proto::new().text(1, name).messages(2, values)
}

/// A `FieldDescriptorProto` of a line such as `repeated Point3 points=2`.
fn field(package: &str, line: &str) -> Proto {
    const REPEATED: u64 = 3;
    let (label, rest) = match line.split_once(' ') {
        Some(("repeated", rest)) => (REPEATED, rest),
        Some(("optional", rest)) => (1, rest),
        _ => (1, line),
    };
    let (kind, rest) = rest.split_once(' ').unwrap_or_default();
    let (name, number) = rest.split_once('=').unwrap_or_default();
    let described = Proto::new()
        .text(1, name)
        .int(3, number.parse().unwrap_or_default())
        .int(4, label);
    let code = match kind {
        "double" => 1,
        "int64" => 3,
        "int32" => 5,
        "fixed32" => 7,
        "bool" => 8,
        "string" => 9,
        "bytes" => 12,
        _ => {
            let is_enumeration = ENUMERATIONS
                .iter()
                .any(|(of, name, _)| kind == format!("{of}.{name}"));
            let full = if kind == TIMESTAMP || kind.contains("protobuf") {
                kind.to_owned()
            } else {
                format!("{package}.{kind}")
            };
            let code = if is_enumeration { 14 } else { 11 };
            return described.int(5, code).text(6, &format!(".{full}"));
        }
    };
    described.int(5, code)
}
