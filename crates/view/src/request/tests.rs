//! Requests from texts, and what is none.

use super::*;

fn parse(text: &str) -> Result<Action, String> {
    Request::parse(text.as_bytes())
        .map(|request| request.action)
        .map_err(|refusal| refusal.reason)
}

#[test]
fn requests_of_the_protocol() {
    assert_eq!(parse(r#"{"id":1,"do":"play"}"#), Ok(Action::Play));
    assert_eq!(parse(r#"{"id":1,"do":"step"}"#), Ok(Action::Step(1)));
    assert_eq!(
        parse(r#"{"id":1,"do":"speed","factor":0}"#),
        Ok(Action::Speed(0.0))
    );
    assert_eq!(
        parse(r#"{"id":1,"do":"select","handles":[3,4]}"#),
        Ok(Action::Select(vec![3, 4]))
    );
    assert_eq!(
        parse(r#"{"id":1,"do":"inspect","handle":-1}"#),
        Ok(Action::Inspect(None))
    );
    assert_eq!(
        parse(r#"{"id":1,"do":"inspect","handle":-13}"#),
        Ok(Action::Inspect(Some(-13)))
    );
    let refusal = Request::parse(br#"{"id":7.5,"do":"explode"}"#).unwrap_err();
    assert_eq!(
        (refusal.id, refusal.reason.as_str()),
        (7.5.into(), "unknown request: explode")
    );
}

#[test]
fn what_is_none_is_refused_with_a_reason() {
    let deep = "[".repeat(100_000);
    for text in [
        "",
        "null",
        "[]",
        "{}",
        deep.as_str(),
        r#"{"id":"1","do":"play"}"#,
        r#"{"id":1}"#,
        r#"{"id":1,"do":5}"#,
        r#"{"id":1,"do":"step","count":0}"#,
        r#"{"id":1,"do":"step","count":1e99}"#,
        r#"{"id":1,"do":"step","count":-1000001}"#,
        r#"{"id":1,"do":"step","count":-9223372036854775808}"#,
        r#"{"id":1,"do":"seek"}"#,
        r#"{"id":1,"do":"seek","frame":-1}"#,
        r#"{"id":1,"do":"seek","frame":1.5}"#,
        r#"{"id":1,"do":"seek","frame":"1"}"#,
        r#"{"id":1,"do":"speed","factor":-1}"#,
        r#"{"id":1,"do":"speed","factor":1e999}"#,
        r#"{"id":1,"do":"select","handles":[1,"2"]}"#,
        r#"{"id":1,"do":"inspect","handle":1.5}"#,
        r#"{"id":1,"do":"set","handle":1,"name":"a"}"#,
        r#"{"id":1,"do":"run"}"#,
        r#"{"id":1,"do":"saveScript","handle":7,"text":"x = 1"}"#,
        r#"{"id":1,"do":"saveScript","handle":7,"text":5,"version":"a"}"#,
        r#"{"id":1,"do":"check"}"#,
        r#"{"id":1,"do":"check","code":"x = 1","language":"perl"}"#,
        r#"{"id":1,"do":"check","code":"x = 1","language":1}"#,
        r#"{"id":1,"do":"edit"}"#,
        r#"{"id":1,"do":"pull","handle":1}"#,
        r#"{"id":1,"do":"pull","handle":1,"point":[1,2]}"#,
        r#"{"id":1,"do":"pull","handle":1,"point":[1,2,"3"],"target":null}"#,
        r#"{"id":1,"do":"upload","name":"a"}"#,
        r#"{"id":1,"do":"upload","name":"a","data":"*"}"#,
        r#"{"id":1,"do":"load"}"#,
        r#"{"id":1,"do":"save"}"#,
        r#"{"id":1,"do":"breakpoints","handle":7}"#,
        r#"{"id":1,"do":"breakpoints","handle":7,"breakpoints":[3]}"#,
        r#"{"id":1,"do":"breakpoints","handle":7,"breakpoints":[{"line":0}]}"#,
        r#"{"id":1,"do":"breakpoints","breakpoints":[]}"#,
        r#"{"id":1,"do":"debug"}"#,
        r#"{"id":1,"do":"debug","command":"disconnect"}"#,
    ] {
        assert!(
            parse(text).is_err_and(|reason| !reason.is_empty()),
            "{}",
            shortened(text)
        );
    }
    assert!(Request::parse(&[0xff, 0xfe]).is_err());
}

#[test]
fn requests_come_back_from_a_capture() {
    for text in [
        r#"{"id":1,"do":"play"}"#,
        r#"{"id":1,"do":"pause"}"#,
        r#"{"id":1,"do":"stop"}"#,
        r#"{"id":1,"do":"step","count":3}"#,
        r#"{"id":1,"do":"step","count":-3}"#,
        r#"{"id":1,"do":"seek","frame":7}"#,
        r#"{"id":1,"do":"live"}"#,
        r#"{"id":1,"do":"speed","factor":0.25}"#,
        r#"{"id":1,"do":"select","handles":[3,4]}"#,
        r#"{"id":1,"do":"inspect","handle":-1}"#,
        r#"{"id":1,"do":"inspect","handle":7}"#,
        r#"{"id":1,"do":"set","handle":3,"name":"alias","value":[1,2.5,"x",null]}"#,
        r#"{"id":1,"do":"script","handle":7}"#,
        r#"{"id":1,"do":"saveScript","handle":7,"text":"x = 1","version":"00ff"}"#,
        r#"{"id":1,"do":"check","code":"x = 1","language":"lua"}"#,
        r#"{"id":1,"do":"check","code":"x = 1","language":"python"}"#,
        r#"{"id":1,"do":"configure","handle":7}"#,
        r#"{"id":1,"do":"watch","handles":[]}"#,
        r#"{"id":1,"do":"show","contacts":true}"#,
        r#"{"id":1,"do":"sample","key":3,"items":[{"handle":7,"name":"pose","index":2},{"handle":7,"name":"mass","index":null}]}"#,
        r#"{"id":1,"do":"graph","handle":7}"#,
        r#"{"id":1,"do":"ui","window":1,"widget":2,"input":{"type":"click"}}"#,
        r#"{"id":1,"do":"run","code":"x = 1"}"#,
        r#"{"id":1,"do":"answer","question":1,"answer":null}"#,
        r#"{"id":1,"do":"edit","edit":"move","arguments":{"handles":[3],"poses":[[0,0,1,0,0,0,1]]},"gesture":5}"#,
        r#"{"id":1,"do":"edit","edit":"drop","arguments":{"handles":[3]}}"#,
        r#"{"id":1,"do":"set","handle":3,"name":"mass","value":1,"gesture":5}"#,
        r#"{"id":1,"do":"undo"}"#,
        r#"{"id":1,"do":"undo","others":false}"#,
        r#"{"id":1,"do":"author","number":5}"#,
        r#"{"id":1,"do":"redo"}"#,
        r#"{"id":1,"do":"pull","handle":3,"point":[0,0,0.5],"target":[1,2,3]}"#,
        r#"{"id":1,"do":"pull","handle":3,"point":[0,0,0.5],"target":null}"#,
        r#"{"id":1,"do":"load","main":"a.urdf","files":{"a.urdf":"PHJvYm90Lz4=","b/c.stl":""},"position":[1,2,0]}"#,
        r#"{"id":1,"do":"save","path":"a.ttt","model":null,"overwrite":true}"#,
        r#"{"id":1,"do":"save","path":"a.ttm","model":7,"overwrite":false}"#,
        r#"{"id":1,"do":"changes"}"#,
        r#"{"id":1,"do":"breakpoints","handle":7,"breakpoints":[{"line":3,"condition":"x > 1"},{"line":5}]}"#,
        r#"{"id":1,"do":"debug","command":"stackTrace","arguments":{"threadId":7}}"#,
    ] {
        let (action, mut bytes) = (parse(text).unwrap(), Vec::new());
        action.write(&mut bytes);
        assert_eq!(Action::read(&mut Input::new(&bytes)), Some(action));
    }
}

#[test]
fn any_bytes_are_a_request_or_none() {
    let good = br#"{"id":1,"do":"set","handle":3,"name":"alias","value":[1,2.5,"x",null]}"#;
    for at in 0..good.len() {
        for byte in 0..=255 {
            let mut bytes = good.to_vec();
            bytes[at] = byte;
            let _ = Request::parse(&bytes);
        }
    }
}
