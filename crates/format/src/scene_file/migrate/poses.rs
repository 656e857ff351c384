//! Positions and orientations relative to joints.
//!
//! Before 4.0.1 a joint stood for its base, whatever its own position; since then it stands for what it moves. Calls whose second
//! argument is not plainly the world go through a function that asks for the base.

use super::old_names::is_part;
use super::texts::end_of_argument;

/// Functions that had the other meaning.
const FUNCTIONS: [&str; 4] = [
    "getObjectPosition",
    "getObjectOrientation",
    "getObjectQuaternion",
    "getObjectMatrix",
];

pub(super) fn relative_to_joints(text: &str) -> String {
    FUNCTIONS
        .iter()
        .fold(text.to_owned(), |text, function| redirect(&text, function))
}

/// Sends the calls of one function through its helper, which is put in front where there are such calls.
fn redirect(text: &str, function: &str) -> String {
    let call = format!("sim.{function}(");
    let helper = format!("__{function}__");
    let mut parts = text.split(&call);
    let mut out = parts.next().unwrap_or_default().to_owned();
    let mut is_needed = false;
    for part in parts {
        let redirected = !is_absolute(part) && !out.ends_with(is_part);
        is_needed |= redirected;
        out.push_str(if redirected {
            &helper
        } else {
            call.trim_end_matches('(')
        });
        out.push('(');
        out.push_str(part);
    }
    if is_needed && !text.contains(&helper) {
        helper_text(function) + &out
    } else {
        out
    }
}

/// Whether the second of these arguments is the world, or is missing.
fn is_absolute(arguments: &str) -> bool {
    let Some(second) = arguments[end_of_argument(arguments)..].strip_prefix(',') else {
        return true;
    };
    ["-1", "sim.handle_world"].contains(&second[..end_of_argument(second)].trim())
}

fn helper_text(function: &str) -> String {
    format!(
        "function __{function}__(object,frame)\n    \
             -- Before 4.0.1 a joint stood for its base here.\n    \
             if frame==sim.handle_parent then\n        \
                 frame=sim.getObjectParent(object)\n    \
             end\n    \
             if frame~=-1 and sim.getObjectType(frame)==sim.object_joint_type then\n        \
                 object=object+sim.handleflag_reljointbaseframe\n    \
             end\n    \
             return sim.{function}(object,frame)\n\
         end\n"
    )
}

#[cfg(test)]
mod tests {
    use super::relative_to_joints;

    #[test]
    fn absolute_calls_stay() {
        for text in [
            "p=sim.getObjectPosition(h,-1)",
            "sim.getObjectMatrix(f(a,b), sim.handle_world )",
            "sim.getObjectPosition(h)",
        ] {
            assert_eq!(relative_to_joints(text), text);
        }
    }

    #[test]
    fn relative_calls_ask_for_the_base_of_joints() {
        let new =
            relative_to_joints("p=sim.getObjectPosition(h,joint)\nq=sim.getObjectPosition(h,-1)");
        let [helper, calls] = new.split("end\np=").collect::<Vec<_>>()[..] else {
            panic!("helper and calls: {new}")
        };
        assert!(helper.starts_with("function __getObjectPosition__(object,frame)\n"));
        assert_eq!(helper.lines().count(), 9);
        assert_eq!(
            calls,
            "__getObjectPosition__(h,joint)\nq=sim.getObjectPosition(h,-1)"
        );
    }
}
