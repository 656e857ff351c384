//! What the macro refuses, and the names and defaults it makes.

use quote::ToTokens;

use super::{Attribute, ItemFn, expand};

fn expanded(attribute: &str, function: &str) -> syn::Result<String> {
    let attribute: Attribute = syn::parse_str(attribute)?;
    let mut function: ItemFn = syn::parse_str(function)?;
    expand(&attribute, &mut function).map(|tokens| tokens.to_string())
}

/// The reason for which the macro refuses a function with these parameters.
fn refusal(doc: &str, parameters: &str) -> String {
    let function = format!("{doc}\nfn f(cx: &Cx, {parameters}) -> Result<()> {{}}");
    expanded("\"sim.f\"", &function)
        .expect_err("the function is refused")
        .to_string()
}

/// The names of the parameters of the row, and of the defaults.
fn names(attribute: &str, parameters: &str) -> Vec<String> {
    let function = format!("fn f(cx: &Cx, {parameters}) -> Result<()> {{}}");
    let text = expanded(attribute, &function).expect("the function is accepted");
    let row = text
        .split("params :")
        .nth(1)
        .and_then(|rest| rest.split("returns :").next())
        .expect("there is a row");
    row.split('"')
        .skip(1)
        .step_by(2)
        .map(str::to_owned)
        .collect()
}

#[test]
fn what_describes_no_parameter_is_refused() {
    let reason = refusal(
        "/// Text.\n/// @param objectId it",
        "object_handle: i64, options: i64",
    );
    assert_eq!(
        reason,
        "`@param objectId` names no parameter of the function: scripts know them as `objectHandle`, `options`"
    );
    assert!(
        refusal("/// @param objectHandle, options", "object_handle: i64")
            .contains("`@param objectHandle,`")
    );
    assert!(refusal("/// @param", "object_handle: i64").contains("`@param `"));
    let none = expanded("\"sim.f\"", "/// @param a\nfn f(cx: &Cx) -> Result<()> {}")
        .expect_err("there is no `a`");
    assert_eq!(
        none.to_string(),
        "`@param a` names no parameter of the function: the function has none"
    );
}

#[test]
fn a_description_names_a_parameter_as_scripts_do() {
    let function = "/// Text.\n/// @param objectHandle it\n/// @param goalUUID its goal\n/// @param ... more\n\
                    fn f(cx: &Cx, object_handle: i64, #[name(\"goalUUID\")] goal_uuid: i64, #[name(\"...\")] further: Rest)\
                    -> Result<()> {}";
    assert!(
        expanded("\"sim.f\"", function)
            .expect("it is accepted")
            .contains("@param goalUUID its goal")
    );
}

#[test]
fn names_are_those_that_scripts_see() {
    let parameters =
        "object_handle: i64, _unused2: bool, r#type: i64, #[name(\"goalUUID\")] goal_uuid: i64";
    assert_eq!(
        names("\"sim.f\"", parameters),
        ["objectHandle", "unused2", "type", "goalUUID"]
    );
    assert_eq!(
        names("\"sim.f\", snake_case", parameters),
        ["object_handle", "unused2", "type", "goalUUID"]
    );
}

#[test]
fn one_name_is_for_one_parameter() {
    assert_eq!(
        refusal("", "_options: i64, options: i64"),
        "scripts would know two parameters as `options`"
    );
}

#[test]
fn a_default_may_be_a_constant() {
    let parameters =
        "#[default(special::WORLD, \"sim.handle_world\")] frame: i64, #[default(-1)] options: i64";
    assert_eq!(
        names("\"sim.f\"", parameters),
        ["frame", "sim.handle_world", "options"]
    );
    assert!(refusal("", "#[default(1, 2)] a: i64").contains("string literal"));
}

/// The compiler knows neither attribute, so none may stay on the function.
#[test]
fn the_function_stays_without_the_attributes_of_the_macro() {
    let function =
        "fn f(cx: &Cx, #[default(1)] #[name(\"B\")] #[allow(unused)] a: i64) -> Result<()> {}";
    let text = expanded("\"sim.f\"", function).expect("it is accepted");
    let stays = "fn f(cx: &Cx, #[allow(unused)] a: i64) -> Result<()> {}";
    let stays: ItemFn = syn::parse_str(stays).expect("it is a function");
    assert!(
        text.starts_with(&stays.to_token_stream().to_string()),
        "{text}"
    );
}
