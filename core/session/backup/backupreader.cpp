// SPDX-License-Identifier: GPL-3.0-or-later
// From the text of a backup to its values, every fault with its line and column.
#include "core/protocol/protocol_values.h"
#include "core/session/backup/backup.h"
#include "core/session/texts.h"
#include "core/table/nearestnames.h"
#include "core/yaml/yamlfaults.h"

#include <algorithm>
#include <map>

namespace dynascope {
namespace {

constexpr int LastAddress = 65535; ///< the last address that a packet can name

class BackupReader : private YamlFaults
{
public:
    BackupReader(const QString &name, const Catalog &catalog) : YamlFaults(name), m_catalog(catalog)
    {
        m_backup.file = name;
    }

    Result<Backup> read(const YamlNode &root)
    {
        if (isBackup(root)) {
            readHead(root);
            if (m_backup.table) {
                for (const QStringView section : {u"registers", u"readings"})
                    readRegisters(root.find(section));
            }
            readBytes(root.find(u"bytes"));
            std::ranges::sort(m_backup.registers, {}, &BackupRegister::field);
            checkIdentity();
        }
        if (const Result<void> sound = asResult(); !sound)
            return tl::unexpected(sound.error());
        return std::move(m_backup);
    }

private:
    bool isBackup(const YamlNode &root)
    {
        const YamlNode *version = root.isMap() ? root.find(u"backup") : nullptr;
        if (!version) {
            say(root, BackupText::tr("\"backup: %1\" is missing, which says that this is one").arg(Backup::Version));
            return false;
        }
        if (version->text != QString::number(Backup::Version)) {
            say(*version, BackupText::tr("backup is %1 here, not \"%2\"").arg(Backup::Version).arg(cut(version->text)));
            return false;
        }
        constexpr std::array Keys{u"backup", u"model", u"model-number", u"firmware", u"id",
                                  u"baud",   u"date",  u"registers",    u"readings", u"bytes"};
        for (std::size_t i = 0; i + 1 < root.children.size(); i += 2) {
            const YamlNode &key = root.children[i];
            const bool isKnown = std::ranges::any_of(Keys, [&](const char16_t *known) { return key.text == known; });
            if (!isKnown)
                say(key, BackupText::tr("\"%1\" is no key of a backup").arg(cut(key.text)));
        }
        return true;
    }

    const YamlNode *needed(const YamlNode &root, QStringView key)
    {
        const YamlNode *node = root.find(key);
        if (!node)
            say(root, BackupText::tr("\"%1\" is missing").arg(key.toString()));
        return node;
    }

    std::optional<std::int64_t> whole(const YamlNode &node, const QString &what, std::int64_t low, std::int64_t high)
    {
        bool ok = false;
        const bool isHex = node.text.startsWith(u"0x");
        const qint64 number = isHex ? node.text.mid(2).toLongLong(&ok, 16) : node.text.toLongLong(&ok);
        const bool isNumber = node.kind == YamlNode::Kind::Scalar && ok && (!isHex || number >= 0);
        if (isNumber && number >= low && number <= high)
            return number;
        say(node, BackupText::tr("%1 is a whole number from %2 to %3, not \"%4\"")
                      .arg(cut(what), QString::number(low), QString::number(high), cut(node.text)));
        return std::nullopt;
    }

    int number(const YamlNode &root, QStringView key, int low, int high)
    {
        const YamlNode *node = needed(root, key);
        return node ? static_cast<int>(whole(*node, key.toString(), low, high).value_or(low)) : low;
    }

    void readHead(const YamlNode &root)
    {
        m_backup.modelNumber = number(root, u"model-number", 0, 65535);
        m_backup.firmware = number(root, u"firmware", 0, 255);
        m_backup.id = number(root, u"id", 0, 252);
        m_backup.baudRate = number(root, u"baud", 1, HighestBaudRate);
        if (const YamlNode *date = needed(root, u"date")) {
            m_backup.at = QDateTime::fromString(date->text, Qt::ISODate).toUTC();
            if (!m_backup.at.isValid())
                say(*date, BackupText::tr("date is a time like 2026-11-28T20:30:00Z, not \"%1\"").arg(cut(date->text)));
        }
        if (const YamlNode *model = needed(root, u"model"))
            readModel(root, *model);
    }

    void readModel(const YamlNode &root, const YamlNode &node)
    {
        const YamlNode *number = root.find(u"model-number");
        const Catalog::ModelInfo *model = m_catalog.model(m_backup.modelNumber);
        m_backup.model = modelName(m_catalog, m_backup.modelNumber);
        if (!number || !areNone())
            return;
        const auto isCalled = [&](const QString &name) { return normalizedName(name) == normalizedName(node.text); };
        if (node.kind != YamlNode::Kind::Scalar
            || (model && !isCalled(model->model) && std::ranges::none_of(model->alsoCalled, isCalled)))
            return say(node, BackupText::tr("model number %1 is that of %2, not \"%3\"")
                                 .arg(m_backup.modelNumber)
                                 .arg(m_backup.model, cut(node.text)));
        m_backup.table = m_catalog.findOrRaw(m_backup.modelNumber, m_backup.firmware);
    }

    void readRegisters(const YamlNode *node)
    {
        if (!node || node->kind == YamlNode::Kind::Null)
            return;
        if (!node->isMap())
            return say(*node, BackupText::tr("registers are \"Name: value\" lines"));
        if (node->children.size() / 2 > Backup::MostRegisters)
            return say(*node, BackupText::tr("more than %1 registers").arg(Backup::MostRegisters));
        if (!m_backup.isKnownModel())
            return say(*node, BackupText::tr("no table tells the registers of model %1").arg(m_backup.modelNumber));
        for (std::size_t i = 0; i + 1 < node->children.size(); i += 2)
            readRegister(node->children[i], node->children[i + 1]);
    }

    void readRegister(const YamlNode &name, const YamlNode &value)
    {
        const Field *field = m_backup.table->find(name.text);
        if (!field) {
            const QStringList near = namesNear(*m_backup.table, name.text);
            const QString what = BackupText::tr("%1 with firmware %2 has no register \"%3\"")
                                     .arg(m_backup.model)
                                     .arg(m_backup.firmware)
                                     .arg(cut(name.text));
            return say(name, near.isEmpty() ? what : what + BackupText::tr("; nearest: %1").arg(near.join(u", ")));
        }
        const int index = m_backup.table->indexOf(field);
        if (const auto [at, isNew] = m_lines.emplace(index, name.line); !isNew)
            return say(name, BackupText::tr("%1 stands in line %2 already").arg(field->name).arg(at->second));
        if (const auto raw = whole(value, field->name, smallestRaw(*field), largestRaw(*field)))
            m_backup.registers.push_back({index, *raw, value.line, value.column});
    }

    /// "50: '00 ff'"
    void readBytes(const YamlNode *node)
    {
        if (!node || node->kind == YamlNode::Kind::Null)
            return;
        if (!node->isMap())
            return say(*node, BackupText::tr("bytes are \"ADDRESS: '00 FF'\" lines"));
        for (std::size_t i = 0; i + 1 < node->children.size(); i += 2) {
            const YamlNode &value = node->children[i + 1];
            const auto address = whole(node->children[i], BackupText::tr("an address"), 0, LastAddress);
            const QByteArray text = value.text.toLatin1().replace(' ', QByteArray());
            const QByteArray bytes = QByteArray::fromHex(text);
            const bool isHex = value.kind == YamlNode::Kind::Scalar && !bytes.isEmpty()
                               && bytes.size() <= Backup::MostBytes && bytes.toHex() == text.toLower();
            if (!isHex)
                say(value, BackupText::tr("bytes are written as pairs of hexadecimal digits, up to %1 of them")
                               .arg(Backup::MostBytes));
            else if (address)
                m_backup.bytes.push_back({static_cast<int>(*address), Bytes(bytes.begin(), bytes.end())});
        }
        std::ranges::sort(m_backup.bytes, {}, &BackupBytes::address);
    }

    /// Put together by hand from two files it would be restored with the meaning of another one.
    void checkIdentity()
    {
        const std::array<std::pair<QStringView, int>, 2> identity{
            std::pair(QStringView(u"Model Number"), m_backup.modelNumber),
            std::pair(QStringView(u"Firmware Version"), m_backup.firmware)};
        for (const auto &[name, wanted] : identity) {
            const BackupRegister *one = m_backup.find(name);
            if (!one || one->raw == wanted)
                continue;
            YamlNode where;
            where.line = one->line;
            where.column = one->column;
            say(where, BackupText::tr("%1 is %2 here, but %3 above").arg(name.toString()).arg(one->raw).arg(wanted));
        }
    }

    const Catalog &m_catalog;
    Backup m_backup;
    std::map<int, int> m_lines; ///< of each field
};

} // namespace

Result<Backup> backupFromYaml(const QByteArray &yaml, const QString &name, const Catalog &catalog)
{
    const auto root = readYaml(yaml, name);
    if (!root)
        return tl::unexpected(root.error());
    return BackupReader(name, catalog).read(*root);
}

} // namespace dynascope
