//! Image filters of vision sensors of V-REP 3: a script since 4.1, which calls simVision (spec: scene-files 7).
//!
//! The meaning of a filter's numbers was found in scenes that contain them; the meaning of single bits is assumed.

use std::fmt::Write as _;

use crate::scene_file::LoadedScript;
use crate::ttt::Counted;
use crate::ttt::chunks::Filter;
use crate::ttt::tree::{Class, Object as FileObject};
use scene::Handle;
use scene::object::script_object::ScriptType;

/// `sim.filtercomponent_*`: the image comes in and goes out. Alone they change nothing, and no script is written for them.
const ORIGINAL_IMAGE: i32 = 1;
const TO_OUTPUT: i32 = 4;

/// Filters without parameters.
const PLAIN: [(i32, &str); 18] = [
    (ORIGINAL_IMAGE, "sensorImgToWorkImg"),
    (2, "sensorDepthMapToWorkImg"),
    (5, "workImgToBuffer1"),
    (6, "workImgToBuffer2"),
    (7, "buffer1ToWorkImg"),
    (8, "buffer2ToWorkImg"),
    (9, "swapBuffers"),
    (10, "addBuffer1ToWorkImg"),
    (11, "subtractBuffer1FromWorkImg"),
    (12, "multiplyWorkImgWithBuffer1"),
    (13, "horizontalFlipWorkImg"),
    (14, "verticalFlipWorkImg"),
    (20, "sharpenWorkImg"),
    (24, "normalizeWorkImg"),
    (29, "swapWorkImgWithBuffer1"),
    (30, "addWorkImgToBuffer1"),
    (31, "subtractWorkImgFromBuffer1"),
    (38, "workImgToSensorDepthMap"),
];

const HEAD: &str = "sim = require 'sim'

-- The image filters that the sensor had in V-REP.
function sysCall_vision(inData)
    local simVision = require 'simVision'
    local sensor, found = inData.handle, {trigger = false, packedPackets = {}}
    local function note(trigger, packet)
        found.trigger = found.trigger or trigger
        found.packedPackets[#found.packedPackets + 1] = packet
    end
";
const END: &str = "    return found\nend\n";

/// The script that replaces the image filters of a vision sensor; None where they change nothing.
pub(super) fn script(object: &FileObject, handle: Handle) -> Option<LoadedScript> {
    let Class::VisionSensor(sensor) = &object.class else {
        return None;
    };
    let filters = sensor
        .filter
        .as_ref()?
        .filters
        .iter()
        .filter(|filter| filter.enabled.unwrap_or(1) != 0);
    let filters: Vec<(i32, &Filter)> = filters
        .filter_map(|filter| Some((filter.kind?[0], filter)))
        .collect();
    if filters
        .iter()
        .all(|(kind, _)| [ORIGINAL_IMAGE, TO_OUTPUT].contains(kind))
    {
        return None;
    }
    let mut code = HEAD.to_owned();
    for (kind, filter) in filters {
        let line = call(kind, filter).unwrap_or_else(|| {
            format!("error('the image filter {kind} of V-REP 3 is not implemented in Swanilda')")
        });
        let _ = writeln!(code, "    {line}");
    }
    Some(LoadedScript {
        script_type: ScriptType::Customization,
        owner: Some(handle),
        code: (code + END).into_bytes(),
        source: None,
        language: "lua".to_owned(),
        disabled: false,
        exec_order: 0,
    })
}

/// The call that does what a filter did; None for one that is not known.
fn call(kind: i32, filter: &Filter) -> Option<String> {
    if kind == TO_OUTPUT {
        // The work image stays, for the filters that follow.
        return Some("simVision.workImgToSensorImg(sensor, false)".to_owned());
    }
    if let Some((_, name)) = PLAIN.iter().find(|(plain, _)| *plain == kind) {
        return Some(format!("simVision.{name}(sensor)"));
    }
    let floats = filter
        .floats
        .as_ref()
        .map_or(&[][..], |Counted(floats)| floats);
    let ints = filter.ints.as_ref().map_or(&[][..], |Counted(ints)| ints);
    let bits = filter
        .bytes
        .as_ref()
        .and_then(|Counted(bytes)| bytes.first())
        .copied()
        .unwrap_or(0);
    let bit = |number: u8| bits >> number & 1 == 1;
    let found = |call: String| format!("note({call})");
    Some(match (kind, floats) {
        (3, [r, g, b, ..]) => format!("simVision.uniformImgToWorkImg(sensor, {{{r}, {g}, {b}}})"),
        (15, [angle, ..]) => format!("simVision.rotateWorkImg(sensor, {angle})"),
        (16, [x, y, ..]) => format!("simVision.shiftWorkImg(sensor, {{{x}, {y}}}, {})", bit(0)),
        (17, [x, y, ..]) => format!("simVision.resizeWorkImg(sensor, {{{x}, {y}}})"),
        (21, [threshold, ..]) => format!("simVision.edgeDetectionOnWorkImg(sensor, {threshold})"),
        (22, [x, y, ..]) => format!(
            "simVision.rectangularCutWorkImg(sensor, {{{x}, {y}}}, {})",
            bit(0)
        ),
        (23, [radius, ..]) => format!("simVision.circularCutWorkImg(sensor, {radius}, {})", bit(0)),
        (25, [start, end, ..]) => {
            let grey = ints.first().is_some_and(|grey| *grey != 0);
            format!("simVision.intensityScaleOnWorkImg(sensor, {start}, {end}, {grey})")
        }
        (26, [a, b, c, d, e, f, ..]) => {
            let [keep, rgb, to_buffer] = [0, 1, 2].map(bit);
            let colours = format!("{{{a}, {b}, {c}}}, {{{d}, {e}, {f}}}");
            format!(
                "simVision.selectiveColorOnWorkImg(sensor, {colours}, {rgb}, {keep}, {to_buffer})"
            )
        }
        (27, [a, b, c, d, e, f, g, h, i, ..]) => {
            let colours = format!("{{{a}, {b}, {c}}}, {{{d}, {e}, {f}}}, {{{g}, {h}, {i}}}");
            format!(
                "simVision.scaleAndOffsetWorkImg(sensor, {colours}, {})",
                bit(0)
            )
        }
        (28, [_, _, _, _, _, _, _, _, _, _, ..]) => {
            let numbers: Vec<String> = floats[..10].iter().map(f32::to_string).collect();
            found(format!(
                "simVision.binaryWorkImg(sensor, {}, {})",
                numbers.join(", "),
                bit(0)
            ))
        }
        (33, [distance, ..]) => format!("simVision.colorSegmentationOnWorkImg(sensor, {distance})"),
        (34, [threshold, smallest, ..]) => found(format!(
            "simVision.blobDetectionOnWorkImg(sensor, {threshold}, {smallest}, {})",
            bit(0)
        )),
        (35, _) => {
            let [columns, rows, ..] = ints else {
                return None;
            };
            found(format!(
                "simVision.coordinatesFromWorkImg(sensor, {{{columns}, {rows}}}, {})",
                bit(0)
            ))
        }
        (36, [threshold, ..]) => found(format!(
            "simVision.changedPixelsOnWorkImg(sensor, {threshold})"
        )),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filter(bytes: &[u8], ints: &[i32], floats: &[f32]) -> Filter {
        Filter {
            bytes: Some(Counted(bytes.to_vec())),
            ints: Some(Counted(ints.to_vec())),
            floats: Some(Counted(floats.to_vec())),
            ..Filter::default()
        }
    }

    #[test]
    fn filters_become_calls() {
        let calls = [
            (
                1,
                filter(&[], &[], &[]),
                "simVision.sensorImgToWorkImg(sensor)",
            ),
            (
                25,
                filter(&[], &[1], &[1.0, 0.0]),
                "simVision.intensityScaleOnWorkImg(sensor, 1, 0, true)",
            ),
            (
                34,
                filter(&[1], &[], &[0.3, 0.0]),
                "note(simVision.blobDetectionOnWorkImg(sensor, 0.3, 0, true))",
            ),
            (
                35,
                filter(&[0], &[342, 1], &[]),
                "note(simVision.coordinatesFromWorkImg(sensor, {342, 1}, false))",
            ),
        ];
        for (kind, filter, expected) in calls {
            assert_eq!(call(kind, &filter).as_deref(), Some(expected));
        }
    }

    #[test]
    fn numbers_that_are_missing_make_no_call() {
        for kind in [
            3, 15, 16, 17, 18, 21, 22, 25, 26, 27, 28, 32, 33, 34, 35, 36, 37, 1000, -5,
        ] {
            assert_eq!(call(kind, &Filter::default()), None, "{kind}");
        }
    }
}
