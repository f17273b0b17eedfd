//! What a wrong formula is told.

use crate::latex::parse;

/// Each source with the text that is marked, and parts of the message and the help.
#[test]
fn errors_name_the_place_and_the_remedy() {
    let cases = [
        ("\\thata + 1", "\\thata", "unknown macro", "`\\theta`"),
        ("a + \\Boldsymbol{x}", "\\Boldsymbol", "unknown macro", "`\\boldsymbol`"),
        ("a + {b", "{", "never closed", "`}`"),
        ("a}", "}", "closes nothing", "`{`"),
        ("\\left( a", "\\left(", "never closed", "\\right)"),
        ("a \\right)", "\\right)", "closes nothing", "\\left("),
        ("{ \\left( a }", "}", "`\\left(` (byte 2) is not closed", "\\right)"),
        ("\\left a", "\\left", "expected a delimiter", "`\\left(`"),
        ("\\begin{aligned} a", "\\begin{aligned}", "never closed", "\\end{aligned}"),
        ("\\begin{aligned} a \\end{array}", "\\end{array}", "is not closed", "\\end{aligned}"),
        ("\\begin{foo} a \\end{foo}", "foo", "unknown environment", "aligned"),
        ("(a + b", "(", "never closed", "close it"),
        ("a + b)", ")", "closes nothing", "open it"),
        ("\\begin{pmatrix} (a & b) \\end{pmatrix}", "(", "never closed", "close it"),
        ("x_1_2", "_2", "a second subscript", "braces"),
        ("x^1^2", "^2", "a second superscript", "braces"),
        ("\\frac{a}", "", "`\\frac` lacks an argument", "`\\frac{..}`"),
        ("\\sqrt + a}", "}", "closes nothing", "`{`"),
        ("x^(2)", "(", "`^` lacks an argument", "braces"),
        ("{a & b}", "&", "nothing to align", "`\\&`"),
        ("a +", "", "expected an operand, found the end", ""),
        ("a + = b", "=", "expected an operand, found `=`", ""),
        ("\\text{a", "{", "never closed", "`}`"),
        ("\\text a", "\\text", "argument in braces", "`\\text{..}`"),
        ("a $ b", "$", "not read", "remove"),
        ("x = |a", "|", "never closed", ""),
        ("a \\", "\\", "backslash at the end", ""),
        ("\\not x", "\\not", "`\\not`", "`\\neq`"),
    ];
    for (source, marked, message, help) in cases {
        let Err(error) = parse(source) else { panic!("{source} is read") };
        assert_eq!(&source[error.span.clone()], marked, "{source}: {error}");
        assert!(error.message.contains(message), "{source}: {error}");
        assert!(error.help.as_deref().unwrap_or("").contains(help), "{source}: {error}");
    }
}

#[test]
fn nested_errors_point_into_the_source() {
    let source = "a = \\frac{1}{\\sqrt{\\lamda}}";
    let Err(error) = parse(source) else { panic!("{source} is read") };
    assert_eq!(&source[error.span.clone()], "\\lamda");
    assert_eq!(error.help.as_deref(), Some("did you mean `\\lambda`?"));
}
