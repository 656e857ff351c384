//! Small text replacements: dialogs, colours, a script's own object, the stop condition, scripts without callbacks.

/// The functions in front of scripts from before 3.1.4. `sim.setShapeColor` knows the mark.
const COLOURS: &str =
    "function colorCorrectionFunction(shape) return '@backCompatibility1:'..shape end ";

/// Attributes of dialogs in XML got a dash with 3.4.1.
pub(super) fn dialog_attributes(text: &str) -> String {
    ["close", "change", "click"]
        .iter()
        .fold(text.to_owned(), |text, event| {
            text.replace(&format!(" on{event}="), &format!(" on-{event}="))
        })
}

/// Shapes whose colour is set are marked, so that the colour means what it did.
pub(super) fn colours(text: &str) -> String {
    const CALL: &str = "sim.setShapeColor(";
    if !text.contains(CALL) || text.contains("colorCorrectionFunction") {
        return text.to_owned();
    }
    let mut parts = text.split(CALL);
    let mut out = COLOURS.to_owned() + parts.next().unwrap_or_default();
    for part in parts {
        let (shape, rest) = part.split_at(end_of_argument(part));
        out.push_str(&format!("{CALL}colorCorrectionFunction({shape}){rest}"));
    }
    out
}

/// Length of the first argument, including nested brackets.
pub(super) fn end_of_argument(text: &str) -> usize {
    let mut depth = 0;
    let end = text.find(|c| {
        match c {
            '(' | '{' | '[' => depth += 1,
            ')' | '}' | ']' => depth -= 1,
            _ => {}
        }
        depth < 0 || depth == 0 && c == ','
    });
    end.unwrap_or(text.len())
}

/// The function that returned the object of a script was replaced in 4.2.
pub(super) fn own_object(text: &str) -> String {
    text.replace(
        "sim.getObjectAssociatedWithScript(sim.handle_self)",
        "sim.getObjectHandle(sim.handle_self)",
    )
}

/// Threads used to ask whether the simulation is about to end. Coroutines are ended from outside, so the answer is always that it goes on.
pub(super) fn end_of_simulation(text: &str) -> String {
    [
        "sim.simulation_advancing_abouttostop",
        "sim_simulation_advancing_abouttostop",
    ]
    .iter()
    .fold(text.to_owned(), |text, state| {
        text.replace(&format!("sim.getSimulationState()~={state}"), "true")
    })
}

/// Calls of functions in other scripts could name these by type and object, as in `'f@/robot'`. They become calls of a function that still
/// can, where the text has one of the two.
pub(super) fn calls_by_type(text: &str) -> String {
    const CALL: &str = "sim.callScriptFunction";
    if !text.contains('@') && !text.contains("scripttype_") {
        return text.to_owned();
    }
    let mut parts = text.split(CALL);
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let is_whole = !part.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '_');
        out.push_str(if is_whole {
            "sim._callScriptFunction"
        } else {
            CALL
        });
        out.push_str(part);
    }
    out
}

/// Before 3.1.3 the whole text ran once per step.
pub(super) fn called_each_step(text: &str, in_sensing: bool) -> String {
    let call = if in_sensing {
        "sysCall_sensing"
    } else {
        "sysCall_actuation"
    };
    format!("function {call}() {text}\nend\n")
}

#[cfg(test)]
mod tests {
    use super::{
        called_each_step, calls_by_type, colours, dialog_attributes, end_of_simulation, own_object,
    };

    #[test]
    fn dialogs() {
        assert_eq!(
            dialog_attributes("<ui onclose=\"f\"><b onclick=\"g\"/></ui>"),
            "<ui on-close=\"f\"><b on-click=\"g\"/></ui>"
        );
        assert_eq!(dialog_attributes("x.onclose='x'"), "x.onclose='x'");
    }

    #[test]
    fn the_shape_is_marked_and_nothing_else() {
        let new = colours("sim.setShapeColor(f(a,b),nil,0,{1,0,0})");
        assert!(
            new.ends_with("sim.setShapeColor(colorCorrectionFunction(f(a,b)),nil,0,{1,0,0})"),
            "{new}"
        );
        assert!(!new.contains('\n'), "lines stay");
        assert_eq!(colours(&new), new, "once");
        assert_eq!(colours("sim.wait(1)"), "sim.wait(1)");
        assert!(
            colours("sim.setShapeColor(").ends_with("sim.setShapeColor(colorCorrectionFunction()")
        );
    }

    #[test]
    fn expressions() {
        assert_eq!(
            own_object("h=sim.getObjectAssociatedWithScript(sim.handle_self)"),
            "h=sim.getObjectHandle(sim.handle_self)"
        );
        assert_eq!(
            own_object("sim.getObjectAssociatedWithScript(s)"),
            "sim.getObjectAssociatedWithScript(s)"
        );
        assert_eq!(
            end_of_simulation(
                "while sim.getSimulationState()~=sim.simulation_advancing_abouttostop do"
            ),
            "while true do"
        );
        assert_eq!(
            end_of_simulation("(sim.getSimulationState()~=sim_simulation_advancing_abouttostop)"),
            "(true)"
        );
    }

    #[test]
    fn calls_that_name_a_type_go_to_the_old_function() {
        let new = "sim._callScriptFunction('f@/a', sim.scripttype_childscript)";
        assert_eq!(
            calls_by_type("sim.callScriptFunction('f@/a', sim.scripttype_childscript)"),
            new
        );
        assert_eq!(calls_by_type(new), new);
        for text in [
            "sim.callScriptFunction('f', h)",
            "sim.callScriptFunctionEx(h) -- @",
        ] {
            assert_eq!(calls_by_type(text), text);
        }
    }

    #[test]
    fn a_text_without_calls_becomes_one() {
        assert_eq!(
            called_each_step("x=1", false),
            "function sysCall_actuation() x=1\nend\n"
        );
        assert!(called_each_step("x=1", true).starts_with("function sysCall_sensing()"));
    }
}
