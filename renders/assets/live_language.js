// The colours of a program's text: which of it are comments, texts, numbers and keywords.

const words = (text) => new Set(text.split(" "));
const st = {
  parts: /(?<comment>\(\*[^]*?(?:\*\)|$)|\/\/.*)|(?<string>'(?:[^'$\n]|\$.)*'?|"(?:[^"$\n]|\$.)*"?)|(?<number>\b(?:\d+#)?\d[\d_.a-zA-Z]*)|(?<word>[A-Za-z_]\w*)/g,
  keywords: words("IF THEN ELSIF ELSE END_IF CASE OF END_CASE FOR TO BY DO END_FOR WHILE END_WHILE REPEAT UNTIL END_REPEAT EXIT CONTINUE RETURN " +
    "PROGRAM END_PROGRAM FUNCTION END_FUNCTION FUNCTION_BLOCK END_FUNCTION_BLOCK TYPE END_TYPE STRUCT END_STRUCT CONFIGURATION END_CONFIGURATION RESOURCE " +
    "END_RESOURCE TASK WITH ON VAR VAR_INPUT VAR_OUTPUT VAR_IN_OUT VAR_TEMP VAR_GLOBAL VAR_EXTERNAL CONSTANT RETAIN END_VAR ARRAY AT AND OR XOR NOT MOD TRUE FALSE " +
    "BOOL SINT INT DINT LINT USINT UINT UDINT ULINT BYTE WORD DWORD LWORD REAL LREAL TIME TOD DATE DT STRING"),
};
const qcl = {
  parts: /(?<comment>;.*)|(?<number>\b\d[\d.]*)|(?<word>[A-Za-z_]\w*)/g,
  keywords: words("IF ELSE ENDIF WHILE ENDWHILE FOR NEXT STEP SUB ENDSUB CALL JUMP WAIT END SETOUT RESOUT NOT AND OR XOR ANDB ORB XORB NOTB EQ NE LT LE GT GE " +
    "CONST SYSTEM GLOBAL ARRSYS ARRGBL TIMER DATAGROUP DATAPROGRAM BUS INPUT OUTPUT INTDEVICE"),
};
const il = {
  // The first word of a line, behind a step number or a bracket.
  parts: /(?<comment>;.*|\/\/.*)|(?<keyword>(?<=^[ \t]*(?:\d+:?[ \t]+)?\[?)[A-Za-z<>=]+)|(?<number>\b[KHE]-?[\dA-F.]+\b)/gm,
  keywords: new Set(),
};
const languages = { st, qcl, cnf: qcl, il };

/// The lines of a text, each as pieces [text, kind]; kind is "" of what has no colour.
export function pieces(text, language) {
  const lines = [[]];
  const add = (piece, kind) => {
    piece.split("\n").forEach((part, i) => {
      if (i > 0) lines.push([]);
      if (part !== "") lines.at(-1).push([part, kind]);
    });
  };
  const { parts, keywords } = languages[language] ?? { parts: /(?!)/g, keywords: new Set() };
  let end = 0;
  for (const found of text.matchAll(parts)) {
    add(text.slice(end, found.index), "");
    let kind = Object.entries(found.groups).find(([, part]) => part !== undefined)?.[0] ?? "";
    if (kind === "word") kind = keywords.has(found[0].toUpperCase()) ? "keyword" : "";
    add(found[0], kind);
    end = found.index + found[0].length;
  }
  add(text.slice(end), "");
  return lines;
}
