// Writes dotek-VERSION.vsix: a zip of the extension with its two manifests. The same bytes for the same inputs.
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { zipSync, strToU8 } from "fflate";

const manifest = JSON.parse(readFileSync("package.json", "utf8"));
delete manifest.scripts;
delete manifest.devDependencies;

const escape = (text) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/"/g, "&quot;");
const vsix = `<?xml version="1.0" encoding="utf-8"?>
<PackageManifest Version="2.0.0" xmlns="http://schemas.microsoft.com/developer/vsx-schema/2011">
  <Metadata>
    <Identity Language="en-US" Id="${manifest.name}" Version="${manifest.version}" Publisher="${manifest.publisher}"/>
    <DisplayName>${escape(manifest.displayName)}</DisplayName>
    <Description xml:space="preserve">${escape(manifest.description)}</Description>
    <Categories>${escape(manifest.categories.join(","))}</Categories>
    <License>extension/LICENSE.txt</License>
    <Properties>
      <Property Id="Microsoft.VisualStudio.Code.Engine" Value="${escape(manifest.engines.vscode)}"/>
    </Properties>
  </Metadata>
  <Installation><InstallationTarget Id="Microsoft.VisualStudio.Code"/></Installation>
  <Dependencies/>
  <Assets>
    <Asset Type="Microsoft.VisualStudio.Code.Manifest" Path="extension/package.json" Addressable="true"/>
    <Asset Type="Microsoft.VisualStudio.Services.Content.Details" Path="extension/README.md" Addressable="true"/>
  </Assets>
</PackageManifest>
`;
const types = `<?xml version="1.0" encoding="utf-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
  <Default Extension=".json" ContentType="application/json"/>
  <Default Extension=".js" ContentType="application/javascript"/>
  <Default Extension=".md" ContentType="text/markdown"/>
  <Default Extension=".txt" ContentType="text/plain"/>
  <Default Extension=".vsixmanifest" ContentType="text/xml"/>
</Types>
`;
const files = {
  "extension.vsixmanifest": strToU8(vsix),
  "[Content_Types].xml": strToU8(types),
  "extension/package.json": strToU8(JSON.stringify(manifest, null, 2) + "\n"),
  "extension/README.md": readFileSync("README.md"),
  "extension/LICENSE.txt": readFileSync("../../LICENSE"),
  "extension/dist/extension.js": readFileSync("dist/extension.js"),
};
for (const name of readdirSync(".").filter((one) => one.startsWith("language-")).sort()) files["extension/" + name] = readFileSync(name);
for (const name of readdirSync("syntaxes").sort()) files["extension/syntaxes/" + name] = readFileSync("syntaxes/" + name);

const name = `${manifest.name}-${manifest.version}.vsix`;
writeFileSync(name, zipSync(files, { level: 9, mtime: new Date("2020-01-01T00:00:00") }));
console.log(name);
